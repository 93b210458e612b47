// Started several times by a launcher of processes, the program writes nothing.
#include "program.h"

namespace kinemesh::testing {
namespace {

using Variables = std::map<std::string, std::string>;

class Launcher : public ProgramTest {
 protected:
  void SetUp() override {
    write("a.off", grid_off(2));
    write(
        "s.toml",
        "[mesh]\nshape = \"square\"\nvertices = 50\n[[motion]]\nfield = \"translate\"\nvelocity = [0.01, 0]\n"
        "[time]\ndt = 0.1\nsteps = 1\n");
    before_ = files();
  }

  Result run_in(const Variables& variables, const std::vector<std::string>& arguments) const {
    const Environment environment(variables);
    return run(arguments);
  }

  std::vector<std::string> before_;
};

const std::vector<std::string> short_run{"run", "s.toml", "-o", "out", "-q"};

TEST_F(Launcher, ThatStartsSeveralIsTold) {
  const std::vector<std::pair<const char*, const char*>> launchers{
      {"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"}, {"PMI_SIZE", "PMI_RANK"},
      {"MV2_COMM_WORLD_SIZE", "MV2_COMM_WORLD_RANK"},   {"MVP_COMM_WORLD_SIZE", "MVP_COMM_WORLD_RANK"},
      {"JSM_NAMESPACE_SIZE", "JSM_NAMESPACE_RANK"},     {"SLURM_STEP_NUM_TASKS", "SLURM_PROCID"},
      {"MPI_LOCALNRANKS", "MPI_LOCALRANKID"},           {"PALS_LOCAL_SIZE", "PALS_RANKID"}};
  for (const auto& [size, rank] : launchers) {
    SCOPED_TRACE(size);
    expect_error(run_in({{size, "3"}, {rank, "0"}}, short_run), 2, {"one of 3 processes", size, "no MPI"});
    expect_error(run_in({{size, "3"}}, short_run), 2, {"one of 3 processes"});
    const Result other = run_in({{size, "3"}, {rank, "2"}}, short_run);
    EXPECT_EQ(other.code, 2);
    EXPECT_EQ(other.out + other.err, "");
    EXPECT_EQ(files(), before_);
  }
}

TEST_F(Launcher, NothingIsWritten) {
  const Variables third{{"OMPI_COMM_WORLD_SIZE", "3"}, {"OMPI_COMM_WORLD_RANK", "0"}};
  const std::vector<std::vector<std::string>> commands{short_run,
                                                       {"run", "absent.toml"},
                                                       {"bench", "s.toml", "--strategies", "global"},
                                                       {"convert", "a.off", "b.off"},
                                                       {"untangle", "a.off", "-o", "b.off"},
                                                       {"draw", "a.off", "-o", "a.svg"},
                                                       {"report", "."},
                                                       {"replay", "x.bin", "--before", "b.off"}};
  for (const auto& command : commands) expect_error(run_in(third, command), 2, {"one of 3 processes"});
  EXPECT_EQ(files(), before_);
}

TEST_F(Launcher, WhatWritesNothingWorks) {
  const Variables third{{"PMI_SIZE", "3"}, {"PMI_RANK", "2"}};
  EXPECT_EQ(run_in(third, {"--version"}).code, 0);
  EXPECT_EQ(run_in(third, {"--help"}).code, 0);
  EXPECT_EQ(run_in(third, {"run", "--help"}).code, 0);
  EXPECT_EQ(run_in(third, {"list"}).code, 0);
  EXPECT_EQ(run_in(third, {"check", "a.off"}).code, 0);
  expect_error(run_in(third, {"replay", "absent.bin"}), 2, {"absent.bin"});
}

TEST_F(Launcher, OneProcessIsNoMatter) {
  for (const char* value : {"1", "0", "-3", "", "3x", "x", "3.0", " 3", "99999999999999999999"}) {
    SCOPED_TRACE(value);
    const Result result =
        run_in({{"OMPI_COMM_WORLD_SIZE", value}, {"PMI_SIZE", value}, {"MPI_LOCALNRANKS", value}},
               {"run", "s.toml", "-o", "out", "-q", "--force"});
    EXPECT_EQ(result.code, 0) << result.err;
  }
}

// The script of a batch job, and the shell of an interactive one, are one process whatever was asked for.
TEST_F(Launcher, BatchJobsAreNoLaunchers) {
  const std::vector<std::string> command{"run", "s.toml", "-o", "out", "-q", "--force"};
  EXPECT_EQ(run_in({{"SLURM_NTASKS", "8"}, {"SLURM_NPROCS", "8"}, {"SLURM_PROCID", "0"}}, command).code, 0);
  EXPECT_EQ(run_in({{"SLURM_STEP_NUM_TASKS", "8"}, {"SLURM_PTY_PORT", "40000"}}, command).code, 0);
}

// One with a size of 1 does not hide the other.
TEST_F(Launcher, AnyOfThemTells) {
  expect_error(run_in({{"SLURM_STEP_NUM_TASKS", "1"}, {"PMI_SIZE", "4"}, {"PMI_RANK", "0"}}, short_run), 2,
               {"one of 4 processes (PMI_SIZE)"});
}

}  // namespace
}  // namespace kinemesh::testing
