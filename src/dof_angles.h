// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <span>

#include "src/skeleton.h"

namespace poselift {

// R of a bone (see Bone): R(dof_n-1) ... R(dof_0), shifts left out.
Eigen::Matrix3d RotationOfDofs(std::span<const Dof> dofs, const double* values);

// The way back: the angles whose product comes closest to `rotation`.
//
// values: one a dof. On entry the angles of the frame before (or of the rest
// pose); on return the new ones. Of the answers that are the same rotation (two
// Euler branches, whole turns) the nearest to the entry is taken, so that a
// curve over time has no jumps. Shifts stay as they are.
// Three different axes express every rotation, also in gimbal lock; with fewer
// the rotation error is smallest. Returns that error, radians.
// Throws std::invalid_argument when two dofs turn about the same axis.
double FitDofAngles(const Eigen::Matrix3d& rotation, std::span<const Dof> dofs, double* values);

// The angle of the rotation between two rotations, radians, exact for tiny ones.
double AngleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b);

}  // namespace poselift
