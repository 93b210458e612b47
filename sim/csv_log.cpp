#include "sim/csv_log.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace kinemesh {

const char* const steps_csv_header =
    "step,time,dt,vertices,faces,inverted,degenerate,components,regions,region_faces,region_faces_max,"
    "explored,"
    "replaced,crease_edges,retries,escaped,quality_flips,min_angle_deg,min_area,move_ms,detect_ms,explore_ms,"
    "triangulate_ms,splice_ms,quality_ms,total_ms,accepted";

const char* const regions_csv_header =
    "step,region,seed,faces,inverted,components,explored,border_edges,crease_edges,self_overlap,retries,x,y";

std::string steps_csv_row(const StepRecord& s) {
  const RepairRecord& r = s.repair;
  const auto ints =
      fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}", s.vertices, s.faces, r.inverted, r.degenerate,
                  r.components, r.regions.size(), r.region_faces(), r.region_faces_max(), r.explored(),
                  r.replaced, r.crease_edges(), r.retries(), r.escaped, r.quality_flips);
  const auto times = fmt::format("{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f},{:.3f}", s.move_ms, r.detect_ms,
                                 r.explore_ms, r.triangulate_ms, r.splice_ms, r.quality_ms, s.total_ms);
  return fmt::format("{},{},{},{},{},{},{},{}", s.step, s.time, s.dt, ints, s.min_angle_deg, s.min_area,
                     times, s.accepted ? 1 : 0);
}

std::string regions_csv_row(int step, int number, const RegionRecord& r) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}", step, number, r.seed, r.faces.size(),
                     r.inverted, r.components, r.explored, r.border_edges, r.crease_edges,
                     r.self_overlap ? 1 : 0, r.retries, r.centre.x, r.centre.y);
}

LineFile::LineFile(const std::filesystem::path& path, std::string_view header)
    : path_(path.string()), file_(std::fopen(path_.c_str(), "wb")) {
  if (!file_) throw InputError(path_, 0, std::string("cannot write: ") + std::strerror(errno));
  write(header);
}

void LineFile::write(std::string_view line) {
  const bool is_written = std::fwrite(line.data(), 1, line.size(), file_.get()) == line.size() &&
                          std::fputc('\n', file_.get()) != EOF && std::fflush(file_.get()) == 0;
  if (!is_written) throw InputError(path_, 0, std::string("cannot write: ") + std::strerror(errno));
}

StepLog::StepLog(const std::filesystem::path& directory)
    : steps_(directory / "steps.csv", steps_csv_header),
      regions_(directory / "regions.csv", regions_csv_header) {}

void StepLog::write(const StepRecord& record) {
  for (size_t i = 0; i < record.repair.regions.size(); ++i)
    regions_.write(regions_csv_row(record.step, static_cast<int>(i), record.repair.regions[i]));
  steps_.write(steps_csv_row(record));
}

}  // namespace kinemesh
