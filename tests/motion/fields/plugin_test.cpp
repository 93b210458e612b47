#include "motion/fields/plugin_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "kinemesh/motion.h"
#include "kinemesh/registry.h"
#include "tests/motion/grid.h"

namespace kinemesh {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string library(const char* name) {
  return std::string(SAMPLE_PLUGINS) + "/" + name + ".so";
}
AnyField sample(FieldParameters parameters) {
  parameters["library"] = library("sample_plugin");
  return make_field("plugin", parameters);
}

std::string refusal(FieldParameters parameters) {
  try {
    (void)make_field("plugin", parameters);
  } catch (const ParameterError& error) {
    EXPECT_EQ(error.key(), "library");
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    return error.what();
  }
  return "none";
}
std::string refusal_of(const char* name) {
  return refusal({{"library", library(name)}});
}

TEST(Plugin, GivesItsVelocityWithTheScenariosParameters) {
  const auto field = sample({{"rate", 2.0}, {"center", std::vector<double>{1.0, -1.0}}});
  EXPECT_EQ(std::get<0>(field)->velocity({3.0, 4.0}, 0.5), Point(4.0, -10.0));
  const auto integer = sample({{"rate", std::int64_t{3}}});
  EXPECT_EQ(std::get<0>(integer)->velocity({1.0, 1.0}, 0.5), Point(3.0, -3.0));
}

TEST(Plugin, GivesItsDisplacement) {
  const auto field = make_field("plugin", {{"library", library("displacing_plugin")}});
  ASSERT_EQ(field.index(), 1u);
  EXPECT_EQ(std::get<1>(field)->displacement({2.0, 3.0}, 0.0), Point(2.0, -3.0));
}

TEST(Plugin, RefusedForItsLibrary) {
  EXPECT_THAT(refusal_of("none"), AllOf(HasSubstr("none.so"), HasSubstr("there is no such file")));
  EXPECT_THAT(refusal_of("later_plugin"), HasSubstr("is made for version 2 of the interface, 1 expected"));
  EXPECT_THAT(refusal_of("odd_plugin"), HasSubstr("is of kind 9, 1 (velocity) or 2 (displacement) expected"));
  EXPECT_THAT(refusal_of("nameless_plugin"), HasSubstr("has no function kinemesh_motion_plugin"));
  const auto text = std::filesystem::path(testing::TempDir()) / "kinemesh_no_library.so";
  std::ofstream(text) << "this is a text";
  EXPECT_THAT(refusal({{"library", text.string()}}), HasSubstr("cannot be loaded: "));
  std::filesystem::remove(text);
  EXPECT_THROW((void)make_field("plugin", {}), ParameterError);
}

TEST(Plugin, RefusesParametersInItsOwnWords) {
  EXPECT_THAT(refusal({{"library", library("sample_plugin")}, {"rat", 1.0}}),
              HasSubstr("no parameter rat that is known"));
  EXPECT_THAT(refusal({{"library", library("sample_plugin")}, {"rate", std::string("fast")}}),
              HasSubstr("no parameter rate"));
  EXPECT_THAT(refusal({{"library", library("sample_plugin")}, {"mode", std::string("throw early")}}),
              HasSubstr("throws too early"));
}

TEST(Plugin, ErrorsAndExceptionsSayWhereAndWhen) {
  const std::map<std::string, std::string> cases{{"error", "the sea is rough"},
                                                 {"throw", "throws out of sorts"},
                                                 {"throw int", "throws something"},
                                                 {"silent", "gives no reason"},
                                                 {"long", "xxxx"}};
  for (const auto& [mode, reason] : cases) {
    const auto field = sample({{"until", 1.0}, {"mode", mode}});
    EXPECT_EQ(std::get<0>(field)->velocity({1.0, 1.0}, 0.5), Point(1.0, -1.0));
    try {
      (void)std::get<0>(field)->velocity({1.5, 1.0}, 2.0);
      ADD_FAILURE() << mode;
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr("sample_plugin.so fails at (1.5, 1), time 2: "),
                                      HasSubstr(reason), Not(HasSubstr("\n"))));
    }
  }
}

TEST(Plugin, StopsAMotionInAllThreads) {
  const Mesh mesh = build_mesh(test::grid(60), {.frame = 0.25, .fixed = {}});
  const Motion motion(mesh, {{sample({{"until", 1.0}}), {}}});
  std::vector<Point> next(mesh.n_vertices());
  EXPECT_NO_THROW(motion.advance(mesh.positions(), 0.0, 0.5, 0, next));
  EXPECT_THROW(motion.advance(mesh.positions(), 0.75, 0.5, 0, next), std::runtime_error);
}

TEST(Plugin, NanIsBlamedOnTheField) {
  const Mesh mesh = build_mesh(test::grid(4), {.frame = 0.25, .fixed = {}});
  const Motion motion(mesh, {{sample({{"until", 0.0}, {"mode", std::string("nan")}}), {}}});
  EXPECT_THAT(
      motion.describe_non_finite(test::grid_vertex(mesh, 4, 2, 2), mesh.positions(), {0.0, 0.1, 0.1, 0}),
      HasSubstr("field \"plugin\" gives (nan"));
}

}  // namespace
}  // namespace kinemesh
