// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/baselines/nearest_exemplar.h"

#include <utility>

#include "lift/lifter.h"

namespace poselift {

NearestExemplar::NearestExemplar(Eigen::MatrixXd exemplars_m, NearestExemplarOptions options)
    : exemplars_m_(std::move(exemplars_m)), options_(std::move(options)) {}

std::optional<Pose3> NearestExemplar::Lift(const Observation& observation) const {
  if (!CanLift(observation).empty()) return std::nullopt;
  const ProjectionOperator op(observation);
  const ViewStart best =
      SearchViews(op, op.CentredPointsOfAll(exemplars_m_), options_.rotation, options_.views)
          .front();
  const auto exemplar = exemplars_m_.col(best.atom);
  const RotationEstimate rotation = EstimateRotation(
      op, op.CentredPoints(exemplar), best.scale_px_per_unit, best.tau_rad, options_.rotation);
  return CamFromBody(rotation.tau_rad) * Unstacked(exemplar);
}

}  // namespace poselift
