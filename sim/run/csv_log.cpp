#include "sim/run/csv_log.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "core/io/file_error.h"

namespace kinemesh {

const char* const steps_csv_header =
    "step,time,dt,vertices,faces,inverted,degenerate,components,regions,region_faces,region_faces_max,"
    "explored,"
    "replaced,crease_edges,retries,escaped,quality_flips,min_angle_deg,min_area,move_ms,detect_ms,explore_ms,"
    "triangulate_ms,splice_ms,quality_ms,total_ms,accepted,interior_ms,quality_moves";

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
  return fmt::format("{},{},{},{},{},{},{},{},{:.3f},{}", s.step, s.time, s.dt, ints, s.min_angle_deg,
                     s.min_area, times, s.accepted ? 1 : 0, s.interior_ms, r.quality_moves);
}

std::string regions_csv_row(int step, int number, const RegionRecord& r) {
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}", step, number, int{r.seed}, r.faces.size(),
                     r.inverted, r.components, r.explored, r.border_edges, r.crease_edges,
                     r.self_overlap ? 1 : 0, r.retries, r.centre.x, r.centre.y);
}

namespace {

// The file is written in place: not where the bytes are another file's, too.
void require_own_bytes(int descriptor, std::uint64_t length, const std::filesystem::path& path) {
  struct stat status;
  if (::fstat(descriptor, &status) != 0) io::fail(path, "cannot read", errno);
  if (!S_ISREG(status.st_mode)) throw InputError(path.string(), 0, "is not a regular file");
  if (status.st_nlink > 1)
    throw InputError(path.string(), 0, "has other names, too (hard links), and would change under them");
  if (static_cast<std::uint64_t>(status.st_size) < length)
    throw InputError(
        path.string(), 0,
        fmt::format("{} bytes long, at least {} expected by the checkpoint", status.st_size, length));
}

int open_log(const std::filesystem::path& path, std::uint64_t length) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) io::fail(path, "cannot write", errno);
  try {
    require_own_bytes(descriptor, length, path);
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  return descriptor;
}

}  // namespace

LineFile::LineFile(const std::filesystem::path& path, std::string_view header)
    : path_(path),
      descriptor_(::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) fail();
  try {
    write(header);
  } catch (...) {
    ::close(descriptor_);
    throw;
  }
}

LineFile::LineFile(const std::filesystem::path& path, std::uint64_t length)
    : path_(path), descriptor_(open_log(path, length)), length_(length) {
  if (::ftruncate(descriptor_, static_cast<off_t>(length)) == 0) return;
  const int error = errno;
  ::close(descriptor_);
  errno = error;
  fail();
}

LineFile::~LineFile() {
  ::close(descriptor_);
}

void LineFile::fail() const {
  io::fail(path_, "cannot write", errno);
}

void LineFile::write(std::string_view line) {
  const std::string text = std::string(line) + "\n";
  for (size_t done = 0; done < text.size();) {
    const ssize_t n = ::write(descriptor_, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) {
      const int error = errno;
      shorten(length_);
      errno = error;
      fail();
    }
    done += static_cast<size_t>(n);
  }
  length_ += text.size();
}

// What is no file of the disk has nothing to flush.
void LineFile::flush() {
  if (::fsync(descriptor_) != 0 && errno != EINVAL) fail();
}

void LineFile::shorten(std::uint64_t length) noexcept {
  if (::ftruncate(descriptor_, static_cast<off_t>(length)) == 0) length_ = length;
}

void require_logs(const std::filesystem::path& directory, const LogLengths& lengths) {
  ::close(open_log(directory / "steps.csv", lengths.steps));
  ::close(open_log(directory / "regions.csv", lengths.regions));
}

StepLog::StepLog(const std::filesystem::path& directory)
    : steps_(directory / "steps.csv", steps_csv_header),
      regions_(directory / "regions.csv", regions_csv_header) {}

StepLog::StepLog(const std::filesystem::path& directory, const LogLengths& lengths)
    : steps_(directory / "steps.csv", lengths.steps), regions_(directory / "regions.csv", lengths.regions) {}

void StepLog::flush() {
  steps_.flush();
  regions_.flush();
}

void StepLog::shorten(const LogLengths& lengths) noexcept {
  steps_.shorten(lengths.steps);
  regions_.shorten(lengths.regions);
}

void StepLog::write(const StepRecord& record) {
  const size_t n_regions = record.accepted ? record.repair.regions.size() : 0;
  for (size_t i = 0; i < n_regions; ++i)
    regions_.write(regions_csv_row(record.step, static_cast<int>(i), record.repair.regions[i]));
  steps_.write(steps_csv_row(record));
}

}  // namespace kinemesh
