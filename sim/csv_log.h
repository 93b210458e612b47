// steps.csv and regions.csv: what each step touched, a line at a time.
#pragma once

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "sim/stepper.h"

namespace kinemesh {

// A text file that grows by whole lines, each handed to the system when it is written.
class LineFile {
 public:
  // Replaces what is there. All throw InputError naming file and reason.
  LineFile(const std::filesystem::path& path, std::string_view header);
  void write(std::string_view line);

 private:
  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };

  std::string path_;
  std::unique_ptr<std::FILE, Close> file_;
};

// Numbers are the shortest decimals that read back as the same double, times of phases milliseconds with
// three digits after the point.
class StepLog {
 public:
  explicit StepLog(const std::filesystem::path& directory);

  // One row in steps.csv, one per region in regions.csv; for rejected steps, too.
  void write(const StepRecord& record);

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
