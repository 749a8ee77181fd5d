// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/body_smoothing.h"

#include <algorithm>
#include <utility>

#include "src/body_transfer.h"

namespace poselift {

bool IsSameBody(const Skeleton& a, const Skeleton& b) {
  return std::equal(
      a.bones.begin(), a.bones.end(), b.bones.begin(), b.bones.end(),
      [](const Bone& x, const Bone& y) {
        return x.name == y.name && x.rest_from_axis.isApprox(y.rest_from_axis, 1e-3) &&
               std::equal(x.dofs.begin(), x.dofs.end(), y.dofs.begin(), y.dofs.end(),
                          [](const Dof& d, const Dof& e) { return d.kind == e.kind; });
      });
}

MotionSmoother SmootherOfBody(Skeleton body, MotionSmoother of_body, MotionSmoother rest) {
  return [body = std::move(body), of_body = std::move(of_body), rest = std::move(rest)](
             const Motion& motion, int max_gap_frames) {
    if (IsSameBody(motion.skeleton, body)) return of_body(motion, max_gap_frames);
    const BodyTransfer transfer(motion.skeleton, body);
    return transfer.CarryBack(rest(motion, max_gap_frames),
                              of_body(transfer.ToBody(motion), max_gap_frames));
  };
}

}  // namespace poselift
