#include "c/errors.h"

#include <cstdint>
#include <new>
#include <vector>

#include "kinemesh/build.h"
#include "kinemesh/error.h"
#include "untangle/walk/stuck.h"

namespace kinemesh {
namespace {

// In the order of kinemesh_defect_kind, from 1.
constexpr DefectKind defect_kinds[] = {
    DefectKind::NonFinitePosition, DefectKind::CoincidentVertices, DefectKind::InvertedFace,
    DefectKind::FlatFace,          DefectKind::CrossingEdges,      DefectKind::VertexOnEdge,
    DefectKind::InsideOut,         DefectKind::LabelsMeet,         DefectKind::LeftDomain,
    DefectKind::Escaped,           DefectKind::HullMoved,          DefectKind::NotPlanar,
    DefectKind::Connectivity,      DefectKind::MissingEdge,        DefectKind::Coverage};
static_assert(std::size(defect_kinds) == KINEMESH_COVERAGE);

std::int32_t number_of(DefectKind kind) {
  std::int32_t number = KINEMESH_NO_DEFECT + 1;
  while (defect_kinds[number - 1] != kind) ++number;
  return number;
}

constexpr kinemesh_defect no_defect{.size = sizeof(kinemesh_defect),
                                    .kind = KINEMESH_NO_DEFECT,
                                    .n_vertices = 0,
                                    .vertices = nullptr,
                                    .n_faces = 0,
                                    .faces = nullptr,
                                    .n_edges = 0,
                                    .edges = nullptr,
                                    .where = {0.0, 0.0}};

// What a thread is told of its last call that failed.
class LastFailure {
 public:
  const char* message() const { return message_.c_str(); }
  const kinemesh_defect& culprits() const { return culprits_; }
  unsigned count() const { return count_; }

  // Keeping a text and numbers may need memory, too: without it they stay away.
  void keep(const char* what, const std::optional<Defect>& defect) noexcept {
    ++count_;
    culprits_ = no_defect;
    message_.clear();
    try {
      message_ = what;
      if (defect) keep(*defect);
    } catch (const std::bad_alloc&) {
    }
  }

 private:
  void keep(const Defect& defect) {
    vertices_.assign(defect.vertices.begin(), defect.vertices.end());
    faces_.assign(defect.faces.begin(), defect.faces.end());
    edges_.clear();
    for (const UserEdge& edge : defect.edges) edges_.insert(edges_.end(), edge.begin(), edge.end());
    culprits_ = {.size = sizeof(kinemesh_defect),
                 .kind = number_of(defect.kind),
                 .n_vertices = static_cast<std::int32_t>(vertices_.size()),
                 .vertices = vertices_.data(),
                 .n_faces = static_cast<std::int32_t>(faces_.size()),
                 .faces = faces_.data(),
                 .n_edges = static_cast<std::int32_t>(defect.edges.size()),
                 .edges = edges_.data(),
                 .where = {defect.where.x, defect.where.y}};
  }

  std::string message_;
  std::vector<std::int32_t> vertices_, faces_, edges_;
  kinemesh_defect culprits_ = no_defect;
  unsigned count_ = 0;
};

thread_local LastFailure last_failure;

kinemesh_status fail(kinemesh_status status, const char* what,
                     const std::optional<Defect>& defect = std::nullopt) noexcept {
  last_failure.keep(what, defect);
  return status;
}

}  // namespace

void refuse(const Defect& defect) {
  const auto status = defect.kind == DefectKind::NonFinitePosition ? KINEMESH_BAD_INPUT
                      : is_stuck(defect)                           ? KINEMESH_STUCK
                                                                   : KINEMESH_NO_VALID_MESH;
  throw Failure(status, defect.message(), defect);
}

unsigned n_failures() noexcept {
  return last_failure.count();
}

kinemesh_status report_exception() noexcept {
  try {
    throw;
  } catch (const Failure& error) {
    return fail(error.status(), error.what(), error.defect());
  } catch (const NoEmbedding& error) {
    return fail(KINEMESH_NO_VALID_MESH, error.what(), error.defect());
  } catch (const InputError& error) {
    return fail(KINEMESH_BAD_INPUT, error.what());
  } catch (const ResourceError& error) {
    return fail(KINEMESH_NO_RESOURCES, error.what());
  } catch (const std::bad_alloc&) {
    return fail(KINEMESH_OUT_OF_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return fail(KINEMESH_BUG, error.what());
  } catch (...) {
    return fail(KINEMESH_BUG, "an unknown exception");
  }
}

}  // namespace kinemesh

using namespace kinemesh;

const char* kinemesh_error(void) {
  return last_failure.message();
}

const kinemesh_defect* kinemesh_culprits(void) {
  return &last_failure.culprits();
}

const char* kinemesh_defect_name(int32_t kind) {
  return kind >= 1 && kind <= KINEMESH_COVERAGE ? to_string(defect_kinds[kind - 1]) : nullptr;
}
