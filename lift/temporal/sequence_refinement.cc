// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#include "lift/temporal/sequence_refinement.h"

#include <ceres/cost_function.h>
#include <ceres/crs_matrix.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/normal_prior.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "lift/temporal/difference_cost.h"
#include "lift/temporal/marginal_covariances.h"
#include "lift/temporal/proportions_cost.h"
#include "src/input_error.h"

namespace poselift {
namespace {

constexpr double kReferenceFrameTime_s = 1.0 / 30.0;
constexpr double kUsualAcceleration = 10.0, kLeastAcceleration = 2.0;  // rad/s^2
const std::vector<double> kChange = {-1.0, 1.0};
const std::vector<double> kSecondDifference = {1.0, -2.0, 1.0};

Eigen::VectorXd Constant(Eigen::Index size, double value) {
  return Eigen::VectorXd::Constant(size, value);
}

// The parameter blocks of a frame.
struct Unknowns {
  SkeletonPose pose;
  Eigen::Vector3d camera;  // log(scale_px_per_m), translation_px

  explicit Unknowns(const RefinedFrame& frame) : pose(frame.pose) {
    camera << std::log(std::max(frame.camera.scale_px_per_m, 1e-9)), frame.camera.translation_px;
  }
  double* root() { return pose.root_in_world_m.data(); }
  double* rotation() { return pose.world_from_root.coeffs().data(); }
  double* dofs() { return pose.dofs.data(); }
};

// One piece as a Ceres problem. body: the standard one; seen: the one before the
// camera, unless its proportions are unknown.
class PieceProblem {
 public:
  PieceProblem(const Articulation& body, const Articulation& seen, const DofSprings& springs,
               const PosePrior& weighted_prior, const SequenceRefinementOptions& options,
               double frame_time_s)
      : body_(body),
        seen_(seen),
        springs_(springs),
        prior_(weighted_prior),
        options_(options),
        dt_s_(frame_time_s),
        root_rate_(std::sqrt(frame_time_s / kReferenceFrameTime_s)),
        problem_(ProblemOptions()) {}

  // Before any frame.
  void AddProportions(const BodyProportions& prior) {
    log_ratios_ = prior.log_ratios;
    const Eigen::MatrixXd whitening =
        std::sqrt(AlikeFrames()) *
        prior.covariance.llt().matrixL().solve(GroupMatrix::Identity()).eval();
    problem_.AddResidualBlock(new ceres::NormalPrior(whitening, prior.log_ratios), nullptr,
                              log_ratios_->data());
  }

  void Add(const FrameEvidence& evidence, const RefinedFrame& start) {
    unknowns_.push_back(std::make_unique<Unknowns>(start));
    if (unknowns_.size() > 1) TakeNearerSign();
    AddBlocks(evidence);
    AddObservation(evidence.observation);
    AddRelations(evidence.observation.relations);
    AddPosePriors(evidence);
    AddScale(evidence.camera.scale_px_per_m);
    if (unknowns_.size() > 1 && evidence.local) AddRate(*evidence.local);
    if (unknowns_.size() > 2) AddSecondDifferences(local_before_);
    local_before_ = evidence.local ? &*evidence.local : nullptr;
  }

  void HoldLast() {
    Unknowns& last = *unknowns_.back();
    for (double* block : {last.root(), last.rotation(), last.dofs(), last.camera.data()})
      problem_.SetParameterBlockConstant(block);
  }

  bool Solve() {
    ceres::Solver::Options solver;
    solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
    solver.max_num_iterations = options_.max_iterations;
    solver.function_tolerance = options_.function_tolerance;
    solver.logging_type = ceres::SILENT;
    ceres::Solver::Summary summary;
    ceres::Solve(solver, &problem_, &summary);
    return summary.IsSolutionUsable();
  }

  // Those given where the normal equations break down.
  BodyProportions Proportions(const BodyProportions& given) {
    ceres::Problem::EvaluateOptions options;
    problem_.GetParameterBlocks(&options.parameter_blocks);
    std::erase_if(options.parameter_blocks, [&](double* block) {
      return block == log_ratios_->data() || problem_.IsParameterBlockConstant(block);
    });
    options.parameter_blocks.push_back(log_ratios_->data());
    ceres::CRSMatrix rows;
    if (!problem_.Evaluate(options, nullptr, nullptr, nullptr, &rows)) return given;
    const Eigen::MatrixXd covariance = CovarianceOfLast(rows, kNumBoneGroups);
    if (covariance.size() == 0) return given;
    return {*log_ratios_, AlikeFrames() * covariance};
  }

  // Where the solve ended; of frames that are held they are empty.
  std::vector<Eigen::MatrixXd> Covariances() {
    ceres::Problem::EvaluateOptions evaluation;
    std::vector<int> sizes;
    for (const auto& frame : unknowns_) {
      sizes.push_back(0);
      for (double* block :
           {frame->rotation(), frame->dofs(), frame->root(), frame->camera.data()}) {
        if (problem_.IsParameterBlockConstant(block)) continue;
        evaluation.parameter_blocks.push_back(block);
        sizes.back() += problem_.ParameterBlockTangentSize(block);
      }
    }
    ceres::CRSMatrix jacobian;
    if (!problem_.Evaluate(evaluation, nullptr, nullptr, nullptr, &jacobian)) return {};
    std::vector<Eigen::MatrixXd> covariances = MarginalCovariances(jacobian, sizes);
    for (Eigen::MatrixXd& covariance : covariances) {
      if (covariance.size() == 0) continue;
      const int size = 3 + body_.num_dofs;
      covariance = covariance.topLeftCorner(size, size).eval();
      covariance.leftCols<3>() *= 2.0;  // the manifold's turns are half as large
      covariance.topRows<3>() *= 2.0;
    }
    return covariances;
  }

  RefinedFrame Result(size_t i) const {
    const Unknowns& unknowns = *unknowns_[i];
    RefinedFrame frame{unknowns.pose, {}, {}};
    frame.pose.world_from_root.normalize();
    frame.camera.cam_from_body = frame.pose.world_from_root.toRotationMatrix();
    frame.camera.scale_px_per_m = std::exp(unknowns.camera[0]);
    frame.camera.translation_px = unknowns.camera.tail<2>();
    return frame;
  }

 private:
  double AlikeFrames() const { return std::max(1.0, options_.alike_s / dt_s_); }

  static ceres::Problem::Options ProblemOptions() {
    ceres::Problem::Options options;
    options.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    return options;
  }

  Unknowns& FromLast(size_t back) { return *unknowns_[unknowns_.size() - 1 - back]; }

  // q and -q are one rotation, but differences of coefficients want one side.
  void TakeNearerSign() {
    auto& turn = FromLast(0).pose.world_from_root;
    if (turn.dot(FromLast(1).pose.world_from_root) < 0.0) turn.coeffs() *= -1.0;
  }

  void AddBlocks(const FrameEvidence& evidence) {
    Unknowns& now = FromLast(0);
    problem_.AddParameterBlock(now.root(), 3);
    if (evidence.observation.Count(ObservedPoint::Kind::k3D) == 0 &&
        evidence.observation.bone_poses.empty() && !evidence.measured && !has_path_)
      problem_.SetParameterBlockConstant(now.root());
    else
      has_path_ = true;
    problem_.AddParameterBlock(now.rotation(), 4, &quaternions_);
    problem_.AddParameterBlock(now.dofs(), body_.num_dofs);
    problem_.AddParameterBlock(now.camera.data(), 3);
  }

  void AddPoseTerm(std::unique_ptr<ceres::CostFunction> cost, ceres::LossFunction* loss) {
    Unknowns& now = FromLast(0);
    problem_.AddResidualBlock(cost.release(), loss, now.root(), now.rotation(), now.dofs());
  }

  void AddObservation(const Observation& observation) {
    std::vector<TargetPoint> in_picture, in_space;
    for (const ObservedPoint& point : observation.points)
      (point.kind == ObservedPoint::Kind::k2D ? in_picture : in_space)
          .push_back({point.parts, point.x, 1.0 / point.sigma});
    Unknowns& now = FromLast(0);
    if (!in_picture.empty() && log_ratios_)
      problem_.AddResidualBlock(MakeProportionsCost(body_, std::move(in_picture)).release(),
                                nullptr, now.root(), now.rotation(), now.dofs(), now.camera.data(),
                                log_ratios_->data());
    else if (!in_picture.empty())
      problem_.AddResidualBlock(MakeReprojectionCost(seen_, std::move(in_picture)).release(),
                                nullptr, now.root(), now.rotation(), now.dofs(), now.camera.data());
    if (!in_space.empty() || !observation.bone_poses.empty())
      AddPoseTerm(MakeSpaceCost(seen_, std::move(in_space), false, observation.bone_poses),
                  nullptr);
  }

  void AddRelations(const std::vector<JointRelation>& relations) {
    if (!relations.empty()) AddPoseTerm(MakeRelationCost(seen_, relations), nullptr);
  }

  void AddPosePriors(const FrameEvidence& evidence) {
    problem_.AddResidualBlock(MakeSpringCost(springs_).release(), nullptr, FromLast(0).dofs());
    if (!prior_.Empty())
      problem_.AddResidualBlock(MakePriorCost(body_, prior_).release(), RateLoss(),
                                FromLast(0).dofs());
    if (evidence.measured) AddPoseTerm(MakePredictionCost(*evidence.measured, 1.0), nullptr);
    if (evidence.lifted_in_cam_m && options_.code_gamma_per_m2 > 0.0) {
      std::vector<TargetPoint> code;
      for (int j = 1; j < kNumJoints; ++j)
        code.push_back({{{j, 1.0}},
                        evidence.lifted_in_cam_m->col(j),
                        root_rate_ * std::sqrt(options_.code_gamma_per_m2)});
      AddPoseTerm(MakeSpaceCost(body_, std::move(code), true), nullptr);
    }
    if (evidence.local && options_.local_weight > 0.0) {
      PosePrediction prediction = evidence.local->prediction;
      prediction.whitening *= options_.local_weight;
      auto* robust = new ceres::ComposedLoss(RateLoss(), ceres::TAKE_OWNERSHIP,
                                             new ceres::CauchyLoss(options_.local_loss),
                                             ceres::TAKE_OWNERSHIP);
      AddPoseTerm(MakePredictionCost(prediction, 1.0), robust);
    }
  }

  // What a second says stays the same at all frame rates.
  ceres::LossFunction* RateLoss() const {
    return new ceres::ScaledLoss(nullptr, root_rate_ * root_rate_, ceres::TAKE_OWNERSHIP);
  }

  void AddScale(double scale_px_per_m) {
    if (!(scale_px_per_m > 0.0)) {
      problem_.SetParameterBlockConstant(FromLast(0).camera.data());
      return;
    }
    const double weight = 1.0 / options_.log_scale_sigma;
    Eigen::Vector3d on_scale(weight, 0.0, 0.0), target(std::log(scale_px_per_m), 0.0, 0.0);
    problem_.AddResidualBlock(MakeDifferenceCost({1.0}, target, on_scale).release(), nullptr,
                              FromLast(0).camera.data());
    if (unknowns_.size() > 1)
      problem_.AddResidualBlock(
          MakeDifferenceCost(kChange, Eigen::Vector3d::Zero(), on_scale / root_rate_).release(),
          nullptr, FromLast(1).camera.data(), FromLast(0).camera.data());
  }

  void AddRate(const LocalPose& local) {
    const double weight = 1.0 / (options_.rate_sigma_rad * local.doubt * root_rate_);
    problem_.AddResidualBlock(
        MakeDifferenceCost(kChange, dt_s_ * local.rate_rad_per_s, Constant(body_.num_dofs, weight))
            .release(),
        nullptr, FromLast(1).dofs(), FromLast(0).dofs());
  }

  // local: of the frame in the middle, or null.
  void AddSecondDifferences(const LocalPose* local) {
    Unknowns &now = FromLast(0), &before = FromLast(1), &first = FromLast(2);
    const double slower = root_rate_ * root_rate_ * root_rate_;
    const auto add = [&](const Eigen::VectorXd& target, const Eigen::VectorXd& sigmas, double* a,
                         double* b, double* c) {
      problem_.AddResidualBlock(
          MakeDifferenceCost(kSecondDifference, target, (slower * sigmas).cwiseInverse()).release(),
          nullptr, a, b, c);
    };
    Eigen::VectorXd expected = Constant(body_.num_dofs, 0.0);
    Eigen::VectorXd sigmas = Constant(body_.num_dofs, options_.acceleration_sigma_rad);
    if (local) {
      expected = dt_s_ * dt_s_ * local->acceleration;
      sigmas.array() *=
          (local->acceleration_deviation.array() + kLeastAcceleration) / kUsualAcceleration;
    }
    add(expected, sigmas, first.dofs(), before.dofs(), now.dofs());
    add(Constant(4, 0.0), Constant(4, options_.turn_sigma), first.rotation(), before.rotation(),
        now.rotation());
    if (has_path_)
      add(Constant(3, 0.0), Constant(3, options_.path_sigma_m), first.root(), before.root(),
          now.root());
  }

  const Articulation& body_;
  const Articulation& seen_;
  const DofSprings& springs_;
  const PosePrior& prior_;
  const SequenceRefinementOptions& options_;
  double dt_s_;
  double root_rate_;
  bool has_path_ = false;
  const LocalPose* local_before_ = nullptr;  // of the frame before the last
  std::optional<GroupVector> log_ratios_;    // where they are unknown
  ceres::EigenQuaternionManifold quaternions_;
  std::vector<std::unique_ptr<Unknowns>> unknowns_;
  ceres::Problem problem_;
};

}  // namespace

std::string SequenceRefinementOptions::Validate() const {
  const std::pair<const char*, double> positive[] = {
      {"local_loss", local_loss},
      {"rate_sigma_rad", rate_sigma_rad},
      {"acceleration_sigma_rad", acceleration_sigma_rad},
      {"turn_sigma", turn_sigma},
      {"path_sigma_m", path_sigma_m},
      {"log_scale_sigma", log_scale_sigma},
      {"alike_s", alike_s}};
  for (const auto& [name, value] : positive)
    if (!(value > 0.0 && std::isfinite(value)))
      return fmt::format("SequenceRefinementOptions::{} = {}, wanted > 0", name, value);
  const std::pair<const char*, double> not_negative[] = {
      {"code_gamma_per_m2", code_gamma_per_m2},
      {"prior_weight", prior_weight},
      {"limit_stiffness", limit_stiffness},
      {"local_weight", local_weight},
      {"function_tolerance", function_tolerance}};
  for (const auto& [name, value] : not_negative)
    if (!(value >= 0.0 && std::isfinite(value)))
      return fmt::format("SequenceRefinementOptions::{} = {}, wanted >= 0", name, value);
  if (max_iterations < 1)
    return fmt::format("SequenceRefinementOptions::max_iterations = {}, wanted at least 1",
                       max_iterations);
  if (piece_frames < 3 || overlap_frames < 0)
    return fmt::format(
        "SequenceRefinementOptions: piece_frames = {} and overlap_frames = {}, wanted at least 3 "
        "and 0",
        piece_frames, overlap_frames);
  return "";
}

SequenceRefinement::SequenceRefinement(const Skeleton& skeleton, PosePrior prior,
                                       const SequenceRefinementOptions& options)
    : body_(skeleton),
      springs_{.limits = DofLimits(body_, /*enforce=*/true),
               .rest = Eigen::VectorXd::Zero(body_.num_dofs),
               .stiffness = options.limit_stiffness},
      weighted_prior_(std::move(prior)),
      options_(options) {
  if (const std::string error = options_.Validate(); !error.empty()) throw InputError(error);
  weighted_prior_.whitening *= options_.prior_weight;
}

std::vector<RefinedFrame> SequenceRefinement::Solve(const std::vector<FrameEvidence>& frames,
                                                    double frame_time_s,
                                                    const GroupVector& log_ratios) const {
  const Articulation seen(WithProportions(body_.skeleton, log_ratios));
  return SolvePieces(frames, frame_time_s, seen, nullptr);
}

std::vector<RefinedFrame> SequenceRefinement::SolveWithProportions(
    const std::vector<FrameEvidence>& frames, double frame_time_s, BodyProportions* body) const {
  return SolvePieces(frames, frame_time_s, body_, body);
}

std::vector<RefinedFrame> SequenceRefinement::SolvePieces(const std::vector<FrameEvidence>& frames,
                                                          double frame_time_s,
                                                          const Articulation& seen,
                                                          BodyProportions* proportions) const {
  std::vector<RefinedFrame> refined;
  for (const FrameEvidence& frame : frames) refined.push_back({frame.start, frame.camera, {}});
  const auto piece = static_cast<size_t>(options_.piece_frames);
  const auto overlap = static_cast<size_t>(options_.overlap_frames);
  for (size_t first = 0; first < frames.size(); first += piece) {
    const size_t held_from = first < 2 ? 0 : first - 2;
    // A short rest is better solved with this piece than alone.
    const bool is_last = first + piece + overlap >= frames.size();
    const size_t end = is_last ? frames.size() : first + piece + overlap;
    PieceProblem problem(body_, seen, springs_, weighted_prior_, options_, frame_time_s);
    if (proportions) problem.AddProportions(*proportions);
    for (size_t t = held_from; t < end; ++t) {
      problem.Add(frames[t], refined[t]);
      if (t < first) problem.HoldLast();
    }
    if (problem.Solve()) {
      // Beside frames that are held, the piece before knows better how sure they are.
      const size_t sure_from = first == 0 ? 0 : first + overlap / 2;
      std::vector<Eigen::MatrixXd> covariances;
      if (options_.covariances && !proportions) covariances = problem.Covariances();
      covariances.resize(end - held_from);
      for (size_t t = first; t < end; ++t) {
        Eigen::MatrixXd covariance =
            std::move(t < sure_from ? refined[t].covariance : covariances[t - held_from]);
        refined[t] = problem.Result(t - held_from);
        refined[t].covariance = std::move(covariance);
      }
      if (proportions) *proportions = problem.Proportions(*proportions);
    }
    if (is_last) break;
  }
  return refined;
}

}  // namespace poselift
