// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
//
// Made-up neighbours, some of a planted linear map. Every method against a slow
// solution of its own equation: the formulas of the paper, normal equations,
// leaving one neighbour out and fitting again. Real data has no part here.
#include "lift/temporal/local_regression.h"

#include <gmock/gmock.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <cmath>
#include <limits>

#include "src/input_error.h"
#include "tests/support/planted_pose.h"
#include "tests/support/support.h"

namespace poselift {
namespace {

using testing::MatrixNear;
using testing::RandomMatrix;
using testing::TestRng;
using Method = LocalRegressionMethod;

constexpr std::array kMethods = {Method::kAsPrinted, Method::kRidge, Method::kPartialLeastSquares,
                                 Method::kPrincipalComponents, Method::kMean};

struct Problem {
  Eigen::MatrixXd x, y;
  Eigen::VectorXd query;
};

// x of `poses` poses of `dofs`, y = A x + b + noise.
Problem Planted(int dofs, int poses, int neighbours, double noise, std::mt19937_64* rng) {
  const int inputs = dofs * poses;
  Problem p{RandomMatrix(inputs, neighbours, rng), {}, 0.3 * RandomMatrix(inputs, 1, rng)};
  const Eigen::MatrixXd map = RandomMatrix(dofs, inputs, rng);
  const Eigen::VectorXd offset = RandomMatrix(dofs, 1, rng);
  p.y = (map * p.x).colwise() + offset;
  p.y += noise * RandomMatrix(dofs, neighbours, rng);
  return p;
}

// Of x itself: nothing done to inputs or outputs beforehand.
LocalRegressionOptions Plain(Method method) {
  LocalRegressionOptions options;
  options.method = method;
  options.target = RegressionTarget::kPose;
  options.velocity_scale = 0.0;
  options.bandwidth = 0.5;
  options.least_stddev = 1e-12;
  return options;
}

LocalPrediction Solve(const Problem& p, const LocalRegressionOptions& options) {
  LocalPrediction prediction;
  LocalRegression().Solve(p.x, p.y, p.query, options, &prediction);
  return prediction;
}

// min over b, a of sum_k omega_k |y_k - b - a^T x_k|^2 + ridge |a|^2 by the normal
// equations, at the query.
Eigen::VectorXd NormalEquations(const Problem& p, const Eigen::VectorXd& weights, double ridge) {
  const Eigen::Index inputs = p.x.rows();
  Eigen::MatrixXd design(p.x.cols(), inputs + 1);
  design << p.x.transpose(), Eigen::VectorXd::Ones(p.x.cols());
  Eigen::MatrixXd normal = design.transpose() * weights.asDiagonal() * design;
  normal.diagonal().head(inputs).array() += ridge;
  const Eigen::MatrixXd coefficients =
      normal.ldlt().solve(design.transpose() * weights.asDiagonal() * p.y.transpose());
  Eigen::VectorXd query(inputs + 1);
  query << p.query, 1.0;
  return coefficients.transpose() * query;
}

// Eq. (7) word for word.
Eigen::VectorXd Weights(const Problem& p, double bandwidth) {
  const Eigen::VectorXd squared = (p.x.colwise() - p.query).colwise().squaredNorm();
  const Eigen::VectorXd weights = (-0.5 * squared.array() / (bandwidth * bandwidth)).exp();
  return weights / weights.sum();
}

double Farthest(const Problem& p) { return (p.x.colwise() - p.query).colwise().norm().maxCoeff(); }

Problem WithoutNeighbour(const Problem& p, Eigen::Index k) {
  const Eigen::Index last = p.x.cols() - 1;
  Problem rest = p;
  rest.x.col(k) = rest.x.col(last);
  rest.y.col(k) = rest.y.col(last);
  rest.x.conservativeResize(Eigen::NoChange, last);
  rest.y.conservativeResize(Eigen::NoChange, last);
  return rest;
}

Eigen::VectorXd Without(const Eigen::VectorXd& values, Eigen::Index k) {
  Eigen::VectorXd rest = values.head(values.size() - 1);
  if (k < rest.size()) rest[k] = values[values.size() - 1];
  return rest;
}

TEST(LocalRegression, FindsAPlantedMapFromEnoughNeighbours) {
  std::mt19937_64 rng = TestRng();
  for (const auto target :
       {RegressionTarget::kPose, RegressionTarget::kChange, RegressionTarget::kAcceleration}) {
    const Problem p = Planted(4, 2, 30, 0.0, &rng);
    LocalRegressionOptions options = Plain(Method::kAsPrinted);
    options.target = target;
    const Eigen::VectorXd truth = NormalEquations(p, Weights(p, 1e3), 0.0);
    for (const double velocity_scale : {0.0, 5.0}) {
      options.velocity_scale = velocity_scale;
      const LocalPrediction found = Solve(p, options);
      EXPECT_TRUE(MatrixNear(found.mean, truth, 1e-9));
      EXPECT_EQ(found.num_components, 8);
      EXPECT_LT(found.stddev.maxCoeff(), 1e-9);
    }
    options.method = Method::kPartialLeastSquares;
    options.num_components = 8;
    EXPECT_TRUE(MatrixNear(Solve(p, options).mean, truth, 1e-9));
    options.method = Method::kPrincipalComponents;
    EXPECT_TRUE(MatrixNear(Solve(p, options).mean, truth, 1e-9));
  }
}

// C of Eq. (8), with the inverse that its sizes want, has rank one: its only
// eigenvector is the solution of least squares, to which Eq. (9) then gives the
// length that least squares gives it.
TEST(LocalRegression, AsPrintedIsWeightedLeastSquares) {
  std::mt19937_64 rng = TestRng();
  const Problem p = Planted(3, 2, 20, 0.5, &rng);
  const Eigen::VectorXd weights = Weights(p, 0.5 * Farthest(p));
  const Eigen::VectorXd mean_x = p.x * weights, mean_y = p.y * weights;
  const Eigen::MatrixXd X = (p.x.colwise() - mean_x).transpose();  // as printed: a row a neighbour
  const Eigen::MatrixXd D = weights.asDiagonal();
  const Eigen::MatrixXd XDX = X.transpose() * D * X;
  const LocalPrediction found = Solve(p, Plain(Method::kAsPrinted));
  for (int d = 0; d < 3; ++d) {
    const Eigen::VectorXd y = p.y.row(d).transpose().array() - mean_y[d];
    const Eigen::MatrixXd C = XDX.inverse() * X.transpose() * D * y * y.transpose() * D * X;
    Eigen::FullPivLU<Eigen::MatrixXd> lu(C);
    EXPECT_EQ(lu.setThreshold(1e-10).rank(), 1);
    const Eigen::EigenSolver<Eigen::MatrixXd> eigen(C);
    Eigen::Index largest;
    eigen.eigenvalues().cwiseAbs().maxCoeff(&largest);
    const Eigen::VectorXd u = eigen.eigenvectors().col(largest).real();
    const Eigen::VectorXd a = u / u.dot(XDX * u) * u.dot(X.transpose() * D * y);  // Eq. (9)
    const Eigen::VectorXd least_squares = XDX.ldlt().solve(X.transpose() * D * y);
    EXPECT_TRUE(MatrixNear(a, least_squares, 1e-9));
    EXPECT_NEAR(found.mean[d], mean_y[d] + a.dot(p.query - mean_x), 1e-9);
  }
  EXPECT_TRUE(MatrixNear(found.mean, NormalEquations(p, weights, 0.0), 1e-9));
}

// With fewer neighbours than inputs: the least |a| of all that fit.
TEST(LocalRegression, AsPrintedIsThePseudoInverseWhereLeastSquaresIsNotUnique) {
  std::mt19937_64 rng = TestRng();
  const Problem p = Planted(5, 4, 9, 0.5, &rng);
  const Eigen::VectorXd weights = Weights(p, 0.5 * Farthest(p));
  const Eigen::VectorXd mean_x = p.x * weights, mean_y = p.y * weights;
  const Eigen::MatrixXd X = (p.x.colwise() - mean_x).transpose();
  const Eigen::MatrixXd a =
      X.completeOrthogonalDecomposition().solve((p.y.colwise() - mean_y).transpose());
  const Eigen::VectorXd want = mean_y + a.transpose() * (p.query - mean_x);
  EXPECT_TRUE(MatrixNear(Solve(p, Plain(Method::kAsPrinted)).mean, want, 1e-8));
}

TEST(LocalRegression, RidgeSolvesTheNormalEquations) {
  std::mt19937_64 rng = TestRng();
  for (const int neighbours : {7, 40}) {
    const Problem p = Planted(4, 3, neighbours, 1.0, &rng);
    const LocalPrediction found = Solve(p, Plain(Method::kRidge));
    EXPECT_GT(found.ridge, 0.0);
    const Eigen::VectorXd weights = Weights(p, 0.5 * Farthest(p));
    EXPECT_TRUE(MatrixNear(found.mean, NormalEquations(p, weights, found.ridge), 1e-8));
  }
}

TEST(LocalRegression, RidgeIsTheOneOfTheGridThatIsBestWhenNeighboursAreLeftOut) {
  std::mt19937_64 rng = TestRng();
  for (const double noise : {0.01, 1.0, 10.0}) {
    const Problem p = Planted(3, 3, 15, noise, &rng);
    const LocalPrediction found = Solve(p, Plain(Method::kRidge));
    const Eigen::VectorXd weights = Weights(p, 0.5 * Farthest(p));
    const auto squares = [&](double ridge) {
      double sum = 0.0;
      for (Eigen::Index k = 0; k < 15; ++k) {
        Problem rest = WithoutNeighbour(p, k);
        rest.query = p.x.col(k);
        sum += weights[k] *
               (p.y.col(k) - NormalEquations(rest, Without(weights, k), ridge)).squaredNorm();
      }
      return sum;
    };
    const Eigen::MatrixXd centred = p.x.colwise() - Eigen::VectorXd(p.x * weights);
    const Eigen::MatrixXd covariance = centred * weights.asDiagonal() * centred.transpose();
    const double largest = covariance.selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff();
    double best = 0.0, least = std::numeric_limits<double>::infinity();
    for (int exponent = -8; exponent <= 1; ++exponent) {
      const double ridge = std::pow(10.0, exponent) * largest;
      if (const double sum = squares(ridge); sum < least) {
        least = sum;
        best = ridge;
      }
    }
    EXPECT_NEAR(found.ridge, best, 1e-6 * best);
    if (noise == 1.0) {
      EXPECT_GT(best, 1e-7 * largest);
      EXPECT_LT(best, largest);
    }
  }
}

TEST(LocalRegression, LeaveOneOutResidualsAreThoseOfFittingAgain) {
  std::mt19937_64 rng = TestRng();
  for (const int neighbours : {6, 25}) {  // fewer and more than the 9 inputs
    const Problem p = Planted(3, 3, neighbours, 0.3, &rng);
    const Eigen::VectorXd weights = Weights(p, 0.5 * Farthest(p));
    for (const auto method : {Method::kRidge, Method::kMean}) {
      LocalRegression solver;
      LocalPrediction found;
      solver.Solve(p.x, p.y, p.query, Plain(method), &found);
      EXPECT_TRUE(MatrixNear(solver.weights(), weights, 1e-12));
      const double ridge = method == Method::kMean ? 1e12 : found.ridge;
      Eigen::MatrixXd want(3, neighbours);
      for (Eigen::Index k = 0; k < neighbours; ++k) {
        Problem rest = WithoutNeighbour(p, k);
        rest.query = p.x.col(k);
        want.col(k) = std::sqrt(weights[k]) *
                      (p.y.col(k) - NormalEquations(rest, Without(weights, k), ridge));
      }
      EXPECT_TRUE(MatrixNear(solver.weighted_loo_residuals(), want, 1e-7));
      EXPECT_TRUE(MatrixNear(found.stddev, want.rowwise().norm(), 1e-7));
    }
  }
}

// All residuals of an exact fit are 0; those of leaving one out are not.
TEST(LocalRegression, DeviationsOfAnExactFitAreThoseOfFittingTheOthersExactly) {
  std::mt19937_64 rng = TestRng();
  const Problem p = Planted(2, 5, 6, 0.3, &rng);
  LocalRegressionOptions options = Plain(Method::kAsPrinted);
  options.bandwidth = 1e6;  // equal weights, which do not change when one is left out
  LocalRegression solver;
  LocalPrediction found;
  solver.Solve(p.x, p.y, p.query, options, &found);
  Eigen::MatrixXd want(2, 6);
  for (Eigen::Index k = 0; k < 6; ++k) {
    Problem rest = WithoutNeighbour(p, k);
    rest.query = p.x.col(k);
    want.col(k) = (p.y.col(k) - Solve(rest, options).mean) / std::sqrt(6.0);
  }
  EXPECT_TRUE(MatrixNear(solver.weighted_loo_residuals(), want, 1e-6));
}

TEST(LocalRegression, FirstPartialLeastSquaresDirectionIsThatOfTheCovariances) {
  std::mt19937_64 rng = TestRng();
  const Problem p = Planted(3, 3, 12, 0.5, &rng);
  LocalRegressionOptions options = Plain(Method::kPartialLeastSquares);
  options.num_components = 1;
  const LocalPrediction found = Solve(p, options);
  const Eigen::VectorXd weights = Weights(p, 0.5 * Farthest(p));
  const Eigen::VectorXd mean_x = p.x * weights, mean_y = p.y * weights;
  const Eigen::MatrixXd X = (p.x.colwise() - mean_x).transpose();
  for (int d = 0; d < 3; ++d) {
    const Eigen::VectorXd y = p.y.row(d).transpose().array() - mean_y[d];
    const Eigen::VectorXd u = X.transpose() * weights.cwiseProduct(y);  // X^T D y
    const Eigen::VectorXd score = X * u;
    const double loading =
        score.dot(weights.cwiseProduct(y)) / score.dot(weights.cwiseProduct(score));
    EXPECT_NEAR(found.mean[d], mean_y[d] + loading * u.dot(p.query - mean_x), 1e-10);
  }
}

// Each further direction is X^T D of what is left of y; the fit is least squares on
// their span, here the Krylov space of X^T D X and X^T D y.
TEST(LocalRegression, PartialLeastSquaresIsLeastSquaresOnTheKrylovSpace) {
  std::mt19937_64 rng = TestRng();
  const Problem p = Planted(2, 4, 14, 0.5, &rng);
  const Eigen::VectorXd weights = Weights(p, 0.5 * Farthest(p));
  const Eigen::VectorXd mean_x = p.x * weights, mean_y = p.y * weights;
  const Eigen::MatrixXd X = (p.x.colwise() - mean_x).transpose();
  const Eigen::MatrixXd XDX = X.transpose() * weights.asDiagonal() * X;
  for (int count = 1; count <= 5; ++count) {
    LocalRegressionOptions options = Plain(Method::kPartialLeastSquares);
    options.num_components = count;
    const LocalPrediction found = Solve(p, options);
    for (int d = 0; d < 2; ++d) {
      const Eigen::VectorXd Xy =
          X.transpose() *
          weights.cwiseProduct(p.y.row(d).transpose() - Eigen::VectorXd::Constant(14, mean_y[d]));
      Eigen::MatrixXd U(8, count);
      U.col(0) = Xy.normalized();
      for (int j = 1; j < count; ++j) U.col(j) = (XDX * U.col(j - 1)).normalized();
      const Eigen::VectorXd a =
          U * (U.transpose() * XDX * U).ldlt().solve(U.transpose() * Xy);  // Eq. (9), U of `count`
      EXPECT_NEAR(found.mean[d], mean_y[d] + a.dot(p.query - mean_x), 1e-8);
    }
  }
}

TEST(LocalRegression, PrincipalComponentsAreThoseOfTheWeightedCovariance) {
  std::mt19937_64 rng = TestRng();
  const Problem p = Planted(3, 3, 12, 0.5, &rng);
  const Eigen::VectorXd weights = Weights(p, 0.5 * Farthest(p));
  const Eigen::VectorXd mean_x = p.x * weights, mean_y = p.y * weights;
  const Eigen::MatrixXd X = (p.x.colwise() - mean_x).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(X.transpose() * weights.asDiagonal() *
                                                             X);
  for (const int count : {1, 2, 5}) {
    LocalRegressionOptions options = Plain(Method::kPrincipalComponents);
    options.num_components = count;
    Problem projected{eigen.eigenvectors().rightCols(count).transpose() * p.x, p.y,
                      eigen.eigenvectors().rightCols(count).transpose() * p.query};
    const LocalPrediction found = Solve(p, options);
    EXPECT_TRUE(MatrixNear(found.mean, NormalEquations(projected, weights, 0.0), 1e-9));
    EXPECT_EQ(found.num_components, count);
    EXPECT_EQ(found.effective_dofs, 1.0 + count);
  }
}

TEST(LocalRegression, FewComponentsAreChosenForFewDirectionsThatMatter) {
  std::mt19937_64 rng = TestRng();
  const Eigen::MatrixXd latent = RandomMatrix(2, 60, &rng);
  Problem p{RandomMatrix(20, 2, &rng) * latent + 0.01 * RandomMatrix(20, 60, &rng),
            RandomMatrix(5, 2, &rng) * latent + 0.1 * RandomMatrix(5, 60, &rng),
            Eigen::VectorXd::Zero(20)};
  for (const auto method : {Method::kPartialLeastSquares, Method::kPrincipalComponents}) {
    const LocalPrediction found = Solve(p, Plain(method));
    EXPECT_GE(found.num_components, 2);
    EXPECT_LE(found.num_components, 5);
    EXPECT_LT(found.stddev.maxCoeff(), 0.2);
  }
}

TEST(LocalRegression, WeightsAreEqualForAWideBandwidthAndOneNeighboursForANarrowOne) {
  std::mt19937_64 rng = TestRng();
  const Problem p = Planted(3, 2, 10, 1.0, &rng);
  LocalRegressionOptions options = Plain(Method::kMean);
  options.bandwidth = 1e9;
  EXPECT_TRUE(MatrixNear(Solve(p, options).mean, p.y.rowwise().mean(), 1e-12));
  Eigen::Index nearest;
  (p.x.colwise() - p.query).colwise().norm().minCoeff(&nearest);
  options.bandwidth = 1e-300;
  EXPECT_TRUE(MatrixNear(Solve(p, options).mean, p.y.col(nearest), 1e-9));
}

TEST(LocalRegression, AbsoluteBandwidthIsThatOfThePaper) {
  std::mt19937_64 rng = TestRng();
  const Problem p = Planted(3, 1, 10, 1.0, &rng);
  LocalRegressionOptions options = Plain(Method::kMean);
  options.bandwidth = 1.0;
  options.relative_bandwidth = false;
  EXPECT_TRUE(MatrixNear(Solve(p, options).mean, p.y * Weights(p, 1.0), 1e-12));
}

TEST(LocalRegression, RowScalesAndVelocitiesAreWhatDoesTheSameToTheInputs) {
  std::mt19937_64 rng = TestRng();
  const Problem p = Planted(3, 3, 12, 1.0, &rng);
  Eigen::MatrixXd transform = Eigen::MatrixXd::Identity(9, 9);  // poses to velocities of scale 4
  for (int row = 3; row < 9; ++row) {
    transform(row, row - 3) = 4.0;
    transform(row, row) = -4.0;
  }
  const Eigen::VectorXd scales = RandomMatrix(9, 1, &rng);
  const Eigen::MatrixXd both = scales.asDiagonal() * transform;
  const Problem transformed{both * p.x, p.y, both * p.query};
  for (const Method method : kMethods) {
    LocalRegressionOptions options = Plain(method);
    const LocalPrediction want = Solve(transformed, options);
    options.row_scales = scales;
    options.velocity_scale = 4.0;
    const LocalPrediction found = Solve(p, options);
    EXPECT_TRUE(MatrixNear(found.mean, want.mean, 1e-9));
    EXPECT_TRUE(MatrixNear(found.stddev, want.stddev, 1e-9));
  }
}

TEST(LocalRegression, ShiftsOfOutputsAndOfInputsGoThrough) {
  std::mt19937_64 rng = TestRng();
  const Problem p = Planted(3, 2, 15, 1.0, &rng);
  const Eigen::VectorXd shift_x = 10.0 * RandomMatrix(6, 1, &rng);
  const Eigen::VectorXd shift_y = 10.0 * RandomMatrix(3, 1, &rng);
  const Problem shifted{p.x.colwise() + shift_x, p.y.colwise() + shift_y, p.query + shift_x};
  for (const Method method : kMethods) {
    const LocalPrediction before = Solve(p, Plain(method));
    const LocalPrediction after = Solve(shifted, Plain(method));
    EXPECT_TRUE(MatrixNear(after.mean, before.mean + shift_y, 1e-9));
    EXPECT_TRUE(MatrixNear(after.stddev, before.stddev, 1e-9));
  }
}

TEST(LocalRegression, MeanOfChangesAndOfAccelerationsFallsBackToThem) {
  std::mt19937_64 rng = TestRng();
  Problem p = Planted(3, 2, 10, 0.0, &rng);
  const Eigen::VectorXd step = RandomMatrix(3, 1, &rng);
  LocalRegressionOptions options = Plain(Method::kMean);
  p.y = p.x.topRows(3).colwise() + step;
  options.target = RegressionTarget::kChange;
  EXPECT_TRUE(MatrixNear(Solve(p, options).mean, p.query.head(3) + step, 1e-12));
  p.y = (2.0 * p.x.topRows(3) - p.x.bottomRows(3)).colwise() + step;
  options.target = RegressionTarget::kAcceleration;
  EXPECT_TRUE(
      MatrixNear(Solve(p, options).mean, 2.0 * p.query.head(3) - p.query.tail(3) + step, 1e-12));
}

TEST(LocalRegression, WhiteningIsThatOfTheShrunkCovariance) {
  std::mt19937_64 rng = TestRng();
  Problem p = Planted(4, 2, 20, 1.0, &rng);
  p.y.row(1) = p.y.row(0) + 0.01 * RandomMatrix(1, 20, &rng);  // errors that go together
  LocalRegressionOptions options = Plain(Method::kRidge);
  options.whitening = true;
  options.shrinkage = 0.2;
  LocalRegression solver;
  LocalPrediction found;
  solver.Solve(p.x, p.y, p.query, options, &found);
  const Eigen::MatrixXd inverse = found.whitening.inverse();
  const Eigen::MatrixXd covariance = inverse * inverse.transpose();
  EXPECT_TRUE(MatrixNear(covariance.diagonal(), found.stddev.cwiseAbs2(), 1e-12));
  const Eigen::MatrixXd& residuals = solver.weighted_loo_residuals();
  EXPECT_NEAR(covariance(0, 1), 0.8 * residuals.row(0).dot(residuals.row(1)), 1e-12);
  EXPECT_GT(covariance(0, 1), 0.75 * found.stddev[0] * found.stddev[1]);
  options.shrinkage = 1.0;
  solver.Solve(p.x, p.y, p.query, options, &found);
  EXPECT_TRUE(
      MatrixNear(found.whitening, found.stddev.cwiseInverse().asDiagonal().toDenseMatrix(), 1e-9));
}

// A planted noise level comes back, also with fewer neighbours than inputs.
TEST(LocalRegression, DeviationsAreThoseOfFreshOutcomes) {
  std::mt19937_64 rng = TestRng();
  for (const int neighbours : {15, 80}) {
    double predicted = 0.0, seen = 0.0;
    for (int trial = 0; trial < 200; ++trial) {
      Problem p = Planted(3, 8, neighbours + 1, 0.5, &rng);
      const Eigen::VectorXd truth = p.y.col(neighbours);
      p.query = p.x.col(neighbours);
      p = WithoutNeighbour(p, neighbours);
      LocalRegressionOptions options = Plain(Method::kRidge);
      options.bandwidth = 2.0;
      const LocalPrediction found = Solve(p, options);
      predicted += found.stddev.squaredNorm();
      seen += (found.mean - truth).squaredNorm();
    }
    EXPECT_NEAR(std::sqrt(seen / predicted), 1.0, 0.2);
  }
}

TEST(LocalRegression, DegenerateNeighboursGiveFiniteAnswers) {
  std::mt19937_64 rng = TestRng();
  std::vector<Problem> problems;
  for (const int neighbours : {1, 2, 3}) problems.push_back(Planted(3, 2, neighbours, 1.0, &rng));
  const Problem base = Planted(3, 2, 8, 1.0, &rng);
  problems.push_back(base);  // duplicates of one
  problems.back().x.colwise() = Eigen::VectorXd(base.x.col(0));
  problems.push_back(problems.back());  // and all at the query
  problems.back().query = base.x.col(0);
  problems.push_back(base);  // two of each
  problems.back().x.rightCols(4) = base.x.leftCols(4);
  problems.back().y.rightCols(4) = base.y.leftCols(4);
  problems.push_back(base);  // constant inputs, constant outputs
  problems.back().x.row(2).setConstant(7.0);
  problems.back().y.row(1).setConstant(7.0);
  problems.push_back(base);  // a query so far away that every weight is 0
  problems.back().query.setConstant(1e8);
  problems.push_back(base);
  problems.back().x *= 1e-150;
  for (size_t i = 0; i < problems.size(); ++i)
    for (const Method method : kMethods)
      for (const int num_components : {0, 1, 100})
        for (const bool relative : {true, false}) {
          LocalRegressionOptions options = Plain(method);
          options.num_components = num_components;
          options.relative_bandwidth = relative;
          options.whitening = true;
          options.velocity_scale = 3.0;
          options.least_stddev = 1e-3;
          const LocalPrediction found = Solve(problems[i], options);
          SCOPED_TRACE(::testing::Message() << "problem " << i << " method " << int(method));
          EXPECT_TRUE(found.mean.allFinite());
          EXPECT_TRUE(found.stddev.allFinite());
          EXPECT_TRUE(found.whitening.allFinite());
          EXPECT_GE(found.stddev.minCoeff(), 1e-3);
        }
}

TEST(LocalRegression, OneNeighbourIsTheAnswer) {
  std::mt19937_64 rng = TestRng();
  const Problem p = Planted(3, 2, 1, 1.0, &rng);
  for (const Method method : kMethods)
    EXPECT_TRUE(MatrixNear(Solve(p, Plain(method)).mean, p.y, 1e-12));
}

TEST(LocalRegression, SolverIsTheSameAfterOtherProblems) {
  std::mt19937_64 rng = TestRng();
  LocalRegression used;
  LocalPrediction first, second;
  for (const int neighbours : {30, 1, 50, 12})
    for (const Method method : kMethods) {
      const Problem p = Planted(4, 2, neighbours, 1.0, &rng);
      LocalRegressionOptions options;
      options.method = method;
      options.whitening = neighbours > 20;
      used.Solve(p.x, p.y, p.query, options, &first);
      LocalRegression().Solve(p.x, p.y, p.query, options, &second);
      EXPECT_EQ(first.mean, second.mean);
      EXPECT_EQ(first.stddev, second.stddev);
      EXPECT_EQ(first.whitening, second.whitening);
      EXPECT_EQ(first.num_components, second.num_components);
    }
}

TEST(LocalRegression, SizesThatDoNotFitAreBadInput) {
  std::mt19937_64 rng = TestRng();
  const Problem good = Planted(3, 2, 5, 1.0, &rng);
  Problem bad = good;
  bad.y.conservativeResize(3, 4);
  EXPECT_THROW(Solve(bad, {}), InputError);
  bad = good;
  bad.query.conservativeResize(5);
  EXPECT_THROW(Solve(bad, {}), InputError);
  bad = {Eigen::MatrixXd(6, 0), Eigen::MatrixXd(3, 0), good.query};
  EXPECT_THROW(Solve(bad, {}), InputError);
  bad = {good.x.topRows(4), good.y, good.query.head(4)};  // not whole poses
  EXPECT_THROW(Solve(bad, {}), InputError);
  EXPECT_NO_THROW(Solve(bad, Plain(Method::kRidge)));
  bad = {good.x.topRows(3), good.y, good.query.head(3)};  // one pose has no velocity
  LocalRegressionOptions options;
  options.target = RegressionTarget::kAcceleration;
  EXPECT_THROW(Solve(bad, options), InputError);
  options = {};
  options.row_scales = Eigen::VectorXd::Ones(5);
  EXPECT_THROW(Solve(good, options), InputError);
}

TEST(LocalRegressionOptions, ValidateNamesTheOptionThatIsWrong) {
  EXPECT_EQ(LocalRegressionOptions().Validate(), "");
  const auto complaint = [](auto change) {
    LocalRegressionOptions options;
    change(options);
    return options.Validate();
  };
  using Options = LocalRegressionOptions;
  using ::testing::HasSubstr;
  EXPECT_THAT(complaint([](Options& o) { o.bandwidth = 0.0; }), HasSubstr("bandwidth = 0"));
  EXPECT_THAT(complaint([](Options& o) { o.bandwidth = std::nan(""); }), HasSubstr("= nan"));
  EXPECT_THAT(complaint([](Options& o) { o.velocity_scale = -1.0; }), HasSubstr("velocity_scale"));
  EXPECT_THAT(complaint([](Options& o) { o.num_components = -1; }), HasSubstr("num_components"));
  EXPECT_THAT(complaint([](Options& o) { o.max_components = 0; }), HasSubstr("max_components"));
  EXPECT_THAT(complaint([](Options& o) { o.least_stddev = 0.0; }), HasSubstr("least_stddev"));
  EXPECT_THAT(complaint([](Options& o) { o.shrinkage = 0.0; }), HasSubstr("shrinkage"));
  EXPECT_THAT(complaint([](Options& o) { o.row_scales = Eigen::VectorXd::Constant(2, NAN); }),
              HasSubstr("row_scales"));
}

}  // namespace
}  // namespace poselift
