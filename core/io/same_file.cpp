#include "core/io/same_file.h"

#include "core/io/atomic_file.h"

namespace kinemesh {
namespace {

namespace fs = std::filesystem;

// Its folder without links and detours; as it is where there is no such folder.
fs::path place_of(const fs::path& path) {
  const fs::path target = fs::absolute(follow_links(path));
  std::error_code error;
  const fs::path folder = fs::canonical(target.parent_path(), error);
  return error ? target.lexically_normal() : folder / target.filename();
}

}  // namespace

bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code error;
  if (fs::equivalent(a, b, error)) return true;
  return place_of(a) == place_of(b);
}

}  // namespace kinemesh
