// `kinemesh report`: everything a run or a benchmark has left in its folder as one HTML page that needs no
// network and no other file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace kinemesh::report {

struct ReportOptions {
  double max_megabytes = 20.0;  // of the page; what does not fit is thinned out, and the page says so
};

struct Report {
  std::string html;
  std::vector<std::string> notes;  // what is not there, and why
};

// Reads run.json, scenario.toml, steps.csv, regions.csv, patches.bin or else mesh_NNNNNN.vtu, and bench.csv,
// whichever are there. Throws InputError: no folder, nothing of a run or benchmark in it, a damaged file, a
// size that not even the plots fit into.
Report make_report(const std::filesystem::path& directory, const ReportOptions& options = {});

}  // namespace kinemesh::report
