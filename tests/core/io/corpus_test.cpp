// A short fuzz in every test run: the committed corpus, cut off at every place and with bytes changed, goes
// through the readers. The long one is scripts/fuzz_readers.sh.
#include <gtest/gtest.h>

#include <random>

#include "core/io/atomic_file.h"
#include "tests/core/io/meshes.h"
#include "tests/fuzz/reader_check.h"

namespace kinemesh {
namespace {

struct Input {
  std::string name, text;
};

class Corpus : public ::testing::TestWithParam<std::string> {
 protected:
  Format format() const { return *format_of("x" + extension()); }
  std::string extension() const {
    for (const FormatInfo& f : formats()) {
      if (f.name == GetParam()) return std::string(f.extension);
    }
    return "";
  }

  std::vector<Input> inputs() const {
    std::vector<Input> found;
    const auto folder = std::filesystem::path(KINEMESH_SOURCE_DIR) / "tests/fuzz/corpus" / GetParam();
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      found.push_back({entry.path().filename().string(), read_file(entry.path())});
    }
    std::sort(found.begin(), found.end(), [](const Input& a, const Input& b) { return a.name < b.name; });
    return found;
  }

  void expect_fine(const std::string& text, const std::string& name) const {
    const std::string wrong = check_reader(text, format());
    EXPECT_EQ(wrong, "") << name << ":\n" << text;
  }
};

TEST_P(Corpus, FilesAreReadOrRefused) {
  ASSERT_GE(inputs().size(), 3u);
  int n_read = 0;
  for (const Input& input : inputs()) {
    expect_fine(input.text, input.name);
    try {
      parse(input.text, format(), true);
      ++n_read;
    } catch (const InputError&) {
    }
  }
  EXPECT_GE(n_read, 2) << "the corpus should hold files that are meshes";
}

TEST_P(Corpus, CutOffAnywhere) {
  for (const Input& input : inputs()) {
    for (std::size_t n = 0; n < input.text.size(); ++n) {
      expect_fine(input.text.substr(0, n), input.name + " up to " + std::to_string(n));
    }
  }
}

TEST_P(Corpus, BytesChanged) {
  std::mt19937 random(7);
  constexpr std::string_view likely = "0123456789-+.eE \n\r\t#%$\"/<>=_\0\xff";
  for (const Input& input : inputs()) {
    for (int i = 0; i < 3000; ++i) {
      std::string text = input.text;
      for (int n = 1 + static_cast<int>(random() % 3); n > 0 && !text.empty(); --n) {
        char& c = text[random() % text.size()];
        c = random() % 2 == 0 ? likely[random() % likely.size()] : static_cast<char>(c ^ (1 << random() % 8));
      }
      expect_fine(text, input.name + " changed, number " + std::to_string(i));
    }
  }
}

TEST_P(Corpus, PartsRepeatedAndRemoved) {
  std::mt19937 random(8);
  for (const Input& input : inputs()) {
    for (int i = 0; i < 1000 && !input.text.empty(); ++i) {
      std::string text = input.text;
      const std::size_t from = random() % text.size(), to = random() % text.size(), n = 1 + random() % 40;
      random() % 2 == 0 ? text.erase(from, n) : text.insert(to, text.substr(from, n));
      expect_fine(text, input.name + " rearranged, number " + std::to_string(i));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Readers, Corpus, ::testing::Values("off", "obj", "ply", "su2", "gmsh", "vtu"),
                         [](const auto& param_info) { return param_info.param; });

}  // namespace
}  // namespace kinemesh
