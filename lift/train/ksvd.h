// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace poselift {

// K-SVD (Aharon, Elad and Bruckstein 2006), Eq. (3) of the sparse coding paper:
//
//   min_{A, X} |Y - A X|_F^2   s.t. |x_j|_0 <= sparsity,  |a_k| = 1
//
// Each iteration codes all poses by OMP, then renews the atoms one by one: with
// E_k the residual of the poses that use atom k, with k's own part put back, the
// atom becomes the first left singular vector of E_k and its coefficients the
// matching right one (by power iteration: the other singular pairs are not
// needed). Atoms nobody uses are replaced by what is left of the worst coded
// poses. Renewing the atoms never raises the error; coding anew can, as OMP is
// greedy: then the training ends with the atoms it had before.
struct KsvdOptions {
  int sparsity = 6;
  int max_iterations = 15;
  double min_improvement = 1e-3;  // relative, of the error; smaller ends the training

  std::string Validate() const;
};

struct KsvdReport {
  // Of a joint, coded by OMP: before each update and at the end. Falls.
  std::vector<double> rms_error_m;
  std::vector<int> atom_use;  // poses that use each atom
};

// poses: 69 x m in metres. atoms: in the start (columns are normalised), out
// the result. Single-threaded and deterministic.
KsvdReport TrainKsvd(const Eigen::MatrixXd& poses, const KsvdOptions& options,
                     Eigen::MatrixXd* atoms);

// RMS of a joint's error in metres from the summed squared error of m poses.
double JointRms_m(double squared_error_m2, Eigen::Index num_poses);

}  // namespace poselift
