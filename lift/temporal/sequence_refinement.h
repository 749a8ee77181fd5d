// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "lift/body_proportions.h"
#include "lift/ik/articulation.h"
#include "lift/ik/pose_costs.h"
#include "lift/pose_prior.h"
#include "lift/temporal/local_pose.h"
#include "lift/weak_camera.h"
#include "src/observation.h"
#include "src/pose3.h"

namespace poselift {

// The deviations of the terms between frames are those at 30 frames a second;
// at other rates they follow the square root of the frame time, those of second
// differences its power 3/2: what a second says stays the same.
struct SequenceRefinementOptions {
  double code_gamma_per_m2 = 5.0;  // of the pose that the frame alone was lifted to
  double prior_weight = 0.4;       // of the dictionary's pose prior
  // Of what the neighbours say of the pose; 0: nothing. Beyond local_loss
  // standard deviations (of all rows together) it counts less and less (Cauchy).
  double local_weight = 1.5;
  double local_loss = 15.0;
  double rate_sigma_rad = 0.005;  // a frame's change, against the neighbours'
  // Second difference of an angle against the neighbours', where accelerations
  // deviate by 10 rad/s^2, and in proportion to them elsewhere (to 2 rad/s^2 more:
  // nothing is quite still). Against nought, and everywhere, without neighbours.
  double acceleration_sigma_rad = 0.01;
  double turn_sigma = 0.005;      // of a coefficient of the root's quaternion
  double path_sigma_m = 0.02;     // of the root's place, with 3D points
  double log_scale_sigma = 0.01;  // to the start's scale, and from frame to frame
  double limit_stiffness = 10.0;  // per radian beyond a dof's limits
  // Frames within this time are wrong alike: for a body's proportions they count as one.
  double alike_s = 2.0;
  bool covariances = true;  // RefinedFrame::covariance is wanted
  double function_tolerance = 1e-4;
  int max_iterations = 30;
  // Long sequences are solved piece by piece: memory is that of a piece. Each is
  // solved with some frames of the next behind it, and holds on to the last two
  // poses of the one before.
  int piece_frames = 300;
  int overlap_frames = 30;

  std::string Validate() const;  // empty, or which option is wrong and why
};

// What is known of one frame.
struct FrameEvidence {
  Observation observation;  // may be empty: then its neighbours in time say where it is
  // Where the solve starts, in cam; also the scale for 2D points.
  SkeletonPose start;
  WeakCamera camera;
  std::optional<Pose3> lifted_in_cam_m;  // pelvis at the origin, from the frame alone
  std::optional<LocalPose> local;
  // Where a noisy motion has the body, root and all, with its frame time 1 s: a
  // Gaussian as the local pose's, but one that is always believed.
  std::optional<PosePrediction> measured;
};

struct RefinedFrame {
  SkeletonPose pose;  // its world is cam; without 3D points and tags the root is at the origin
  WeakCamera camera;
  // Of (w, dofs), 3 + D: how sure they are by the Gaussian approximation of the
  // posterior at its maximum (Laplace), where w turns the root in cam, Exp(w) R.
  // Empty where the solver breaks down, and unless the options want it.
  Eigen::MatrixXd covariance;
};

// The MAP of a whole sequence, Eq. (2) of the motion paper with frames to come as
// well as those before, over poses q_t, scales and translations of the camera:
//
//   min sum_t  reprojection, 3D points, tags and hints of the frame, as (P0)
//            + gamma |f(q_t) - y_t|^2 + prior_weight^2 |whitening (f_0 - mean)|^2
//            + rho(|local whitening delta(q_t)|^2)                  (local_pose.h)
//            + |q_t - q_t-1 - dt rate_t|^2 / rate_sigma^2
//            + stiffness^2 |q_t beyond its limits|^2
//            + |q_t - 2 q_t-1 + q_t-2 - dt^2 a_t-1|^2 / acceleration_sigma_t^2
//            + the root's second differences
//
// by Levenberg-Marquardt; the normal equations are a band, so the cost is linear
// in frames, that of the covariances too (marginal_covariances.h). What was learned of
// poses is about the standard skeleton, so f(q) there is that of the standard skeleton
// at the angles of q; labels see the body itself.
class SequenceRefinement {
 public:
  // Throws InputError for wrong options.
  SequenceRefinement(const Skeleton& skeleton, PosePrior prior,
                     const SequenceRefinementOptions& options = {});

  // Poses for all frames; those of `start` where the solver breaks down. The body
  // has the standard proportions, or these.
  std::vector<RefinedFrame> Solve(const std::vector<FrameEvidence>& frames, double frame_time_s,
                                  const GroupVector& log_ratios = GroupVector::Zero()) const;

  // The same with the proportions as unknowns of all frames. With alike frames
  // counted as one, n = alike_s / frame_time_s of them (at least 1),
  //
  //   min over q_t, cameras, rho   sum_t (as above)  +  n |rho - mean|^2_covariance
  //
  // *body: on entry mean and covariance, on return rho and n times its block of the
  // inverse of the Gauss-Newton matrix of all unknowns: a length that some other pose
  // could explain as well stays as unsure as it was. Each piece of a long sequence
  // starts with what those before it have found.
  std::vector<RefinedFrame> SolveWithProportions(const std::vector<FrameEvidence>& frames,
                                                 double frame_time_s, BodyProportions* body) const;

 private:
  // Piece by piece, with *proportions unknown unless it is null.
  std::vector<RefinedFrame> SolvePieces(const std::vector<FrameEvidence>& frames,
                                        double frame_time_s, const Articulation& seen,
                                        BodyProportions* proportions) const;

  Articulation body_;
  DofSprings springs_;
  PosePrior weighted_prior_;  // its whitening times prior_weight
  SequenceRefinementOptions options_;
};

}  // namespace poselift
