// steps.csv and regions.csv: what each step touched, a line at a time.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "kinemesh/stepper.h"

namespace kinemesh {

// A text file that grows by whole lines, each handed to the system when it is written. Never writes through a
// link of either kind. Errors are InputErrors and ResourceErrors naming file and reason.
class LineFile {
 public:
  LineFile(const std::filesystem::path& path, std::string_view header);  // a new one; nothing may be there
  LineFile(const std::filesystem::path& path, std::uint64_t length);     // goes on behind so many bytes
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;
  ~LineFile();

  void write(std::string_view line);  // whole, or nothing of it unless the disk fails altogether
  void flush();                       // to the disk
  std::uint64_t length() const { return length_; }  // bytes
  void shorten(std::uint64_t length) noexcept;      // takes back what was written since; as far as it can

 private:
  [[noreturn]] void fail() const;

  std::filesystem::path path_;
  int descriptor_;
  std::uint64_t length_ = 0;
};

struct LogLengths {
  std::uint64_t steps = 0, regions = 0;  // bytes
};

// Throws what going on with a folder's logs behind these lengths would throw, and changes nothing.
void require_logs(const std::filesystem::path& directory, const LogLengths& lengths);

// Numbers are the shortest decimals that read back as the same double, times of phases milliseconds with
// three digits after the point.
class StepLog {
 public:
  explicit StepLog(const std::filesystem::path& directory);
  StepLog(const std::filesystem::path& directory, const LogLengths& lengths);  // drops what comes behind them

  // One row in steps.csv, for rejected steps, too; one per region in regions.csv, which of a rejected step
  // are none, as they were not replaced.
  void write(const StepRecord& record);

  void flush();
  LogLengths lengths() const { return {steps_.length(), regions_.length()}; }
  void shorten(const LogLengths& lengths) noexcept;

 private:
  LineFile steps_;
  LineFile regions_;
};

// Their first lines and their rows; a contract.
extern const char* const steps_csv_header;
extern const char* const regions_csv_header;
std::string steps_csv_row(const StepRecord& record);
std::string regions_csv_row(int step, int number, const RegionRecord& region);

}  // namespace kinemesh
