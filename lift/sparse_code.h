// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <utility>
#include <vector>

namespace poselift {

// A sparse x: the atoms it uses, in the order they were chosen.
struct SparseCode {
  std::vector<int> atoms;
  Eigen::VectorXd coefficients;  // one for each of atoms

  bool Empty() const { return atoms.empty(); }
};

// A x, for a dictionary with atoms as columns.
template <typename Atoms>
Eigen::VectorXd Synthesize(const Atoms& atoms, const SparseCode& code) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(atoms.rows());
  for (size_t i = 0; i < code.atoms.size(); ++i)
    sum += code.coefficients[static_cast<Eigen::Index>(i)] * atoms.col(code.atoms[i]);
  return sum;
}

}  // namespace poselift
