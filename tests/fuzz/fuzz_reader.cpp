// One libFuzzer target per reader: KINEMESH_FUZZ_FORMAT is an enumerator of Format.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "tests/fuzz/reader_check.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string wrong = kinemesh::check_reader({reinterpret_cast<const char*>(data), size},
                                                   kinemesh::Format::KINEMESH_FUZZ_FORMAT);
  if (wrong.empty()) return 0;
  std::fprintf(stderr, "%s\n", wrong.c_str());
  std::abort();
}
