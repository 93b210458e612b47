#include "sim/cli/launcher.h"

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <cstdlib>
#include <string_view>

#include "sim/cli/console.h"

namespace kinemesh::cli {
namespace {

// What launchers tell the processes they start: their number, and which of them one is. SLURM_NTASKS is none
// of these: sbatch sets it for its script, which is one process.
struct Variables {
  const char *size, *rank;
  const char* unless = "";  // set in a shell that has been started so, whose commands are single processes
};
constexpr std::array launchers{Variables{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},  // Open MPI
                               Variables{"PMI_SIZE", "PMI_RANK"},  // MPICH, Intel MPI, flux, srun --mpi=pmi2
                               Variables{"MV2_COMM_WORLD_SIZE", "MV2_COMM_WORLD_RANK"},  // MVAPICH2
                               Variables{"MVP_COMM_WORLD_SIZE", "MVP_COMM_WORLD_RANK"},  // MVAPICH 3
                               Variables{"JSM_NAMESPACE_SIZE", "JSM_NAMESPACE_RANK"},    // jsrun
                               Variables{"SLURM_STEP_NUM_TASKS", "SLURM_PROCID", "SLURM_PTY_PORT"},  // srun
                               Variables{"MPI_LOCALNRANKS", "MPI_LOCALRANKID"},  // on a machine, by Hydra
                               Variables{"PALS_LOCAL_SIZE", "PALS_RANKID"}};     // likewise, by PALS

std::optional<int> number_in(const char* variable) {
  const char* text = std::getenv(variable);
  if (text == nullptr) return std::nullopt;
  const std::string_view digits = text;
  int value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  const bool is_number = error == std::errc() && end == digits.data() + digits.size();
  return is_number && value >= 0 ? std::optional(value) : std::nullopt;
}

bool writes_files(const CLI::App& command) {
  const std::string name = command.get_name();
  if (name == "replay") return command.count("--before") + command.count("--after") > 0;
  return name != "check" && name != "list";
}

}  // namespace

std::optional<Launch> find_launch() {
  for (const Variables& variables : launchers) {
    const auto size = number_in(variables.size);
    if (!size || *size <= 1 || std::getenv(variables.unless) != nullptr) continue;
    return Launch{*size, number_in(variables.rank).value_or(0) == 0, variables.size};
  }
  return std::nullopt;
}

bool refuse_several(const CLI::App& program) {
  if (!writes_files(*program.get_subcommands().front())) return false;
  const auto launch = find_launch();
  if (launch && launch->is_first)
    print_error(fmt::format("started as one of {} processes ({}): this build has no MPI; start it once",
                            launch->size, launch->told_by));
  return launch.has_value();
}

}  // namespace kinemesh::cli
