// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "tests/support/support.h"

#include <cstdlib>
#include <fstream>

namespace poselift::testing {
namespace {

std::string TestName() {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(info->test_suite_name()) + "." + info->name();
  for (char& c : name)
    if (c == '/') c = '_';
  return name;
}

}  // namespace

std::mt19937_64 TestRng() {
  const std::string name = TestName();
  std::seed_seq seed(name.begin(), name.end());
  return std::mt19937_64(seed);
}

std::filesystem::path ScratchDir() {
  auto dir = std::filesystem::path(POSELIFT_SCRATCH_DIR) / TestName();
  static std::string cleared;
  if (cleared != dir) {
    std::filesystem::remove_all(dir);
    cleared = dir;
  }
  std::filesystem::create_directories(dir);
  return dir;
}

std::filesystem::path SourcePath(const std::string& relative) {
  return std::filesystem::path(POSELIFT_SOURCE_DIR) / relative;
}

std::optional<std::filesystem::path> DataDir() {
  const char* named = std::getenv("POSELIFT_DATA");
  const std::filesystem::path dir = named ? named : SourcePath("../shared").string();
  if (!std::filesystem::is_directory(dir / "mocap")) return std::nullopt;
  return dir;
}

std::string WriteScratch(const std::string& name, const std::string& text) {
  const auto path = ScratchDir() / name;
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

::testing::AssertionResult MatrixNear(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b,
                                      double tolerance) {
  if (a.rows() != b.rows() || a.cols() != b.cols())
    return ::testing::AssertionFailure() << "sizes differ: " << a.rows() << "x" << a.cols()
                                         << " and " << b.rows() << "x" << b.cols();
  const double worst = a.size() == 0 ? 0.0 : (a - b).cwiseAbs().maxCoeff<Eigen::PropagateNaN>();
  if (worst <= tolerance) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure()
         << "differ by " << worst << ", more than " << tolerance << "\n"
         << a << "\n--\n"
         << b;
}

}  // namespace poselift::testing
