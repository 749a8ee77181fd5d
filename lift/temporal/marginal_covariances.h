// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <vector>

namespace ceres {
struct CRSMatrix;
}

namespace poselift {

// How sure the unknowns of each frame are in a least squares problem over time: the
// diagonal blocks of (J^T J + 1e-9 I)^-1, J the Jacobian of the residuals over their
// standard deviations. A block a frame, frame_sizes[t]^2; J's columns are the frames'
// in order.
//
// No residual knows more than three frames in a row, so that pairs of frames couple
// with the pairs beside them alone. With A_k and B_k the blocks of J^T J on the
// diagonal and below it,
//   D_0 = A_0,  K_k = B_k D_k^-1,  D_k+1 = A_k+1 - K_k B_k^T      forward
//   S_n = D_n^-1,  S_k = D_k^-1 + K_k^T S_k+1 K_k                 and back:
// linear in frames. The 1e-9 is what is known of what no residual tells of.
//
// Empty when the Cholesky decomposition breaks down. Throws std::invalid_argument for
// residuals of more frames and for sizes that are not those of J.
std::vector<Eigen::MatrixXd> MarginalCovariances(const ceres::CRSMatrix& jacobian,
                                                 const std::vector<int>& frame_sizes);

// The same of the last `size` unknowns, which all frames may have in common: a sparse
// decomposition of the whole. Empty when it breaks down.
Eigen::MatrixXd CovarianceOfLast(const ceres::CRSMatrix& jacobian, int size);

}  // namespace poselift
