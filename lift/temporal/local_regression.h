// SPDX-License-Identifier: MIT
// Copyright (c) 2026 the poselift authors
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <string>

namespace poselift {

// The next pose of a motion from K remembered motions that came to a similar
// place: Mousas, Newbury, Anagnostopoulos, "Data-Driven Motion Reconstruction
// Using Local Regression Models" (2014), section 4.1. One linear model for each
// degree of freedom d,
//
//   y_d = mean(y_d) + a_d^T (x - mean(x)) + N(0, sigma_d^2)              Eq. (3), (10)
//
// fitted to the neighbours (x_k, y_k) under the weights omega_k of Eq. (7), and
// taken at the query x = [q_{t-1}; ...; q_{t-m}]. Means are weighted ones.
//
// With K neighbours and P = m D inputs, usually more than K, least squares is not
// unique. All methods therefore work on the K x K Gram matrix of the weighted,
// centred inputs, whose eigenvalues l_i are shared by all D models. What the
// methods differ in is how much of the i-th principal direction they use.
// lift/README.md has the derivation and what is wrong in the print.
//
// Neighbours should be of different motions, or well apart in time: frames next
// to each other foretell each other so well that everything that is chosen or
// estimated by leaving one out is too sure of itself.
enum class LocalRegressionMethod {
  // Eq. (9) as it stands: weighted least squares, by the pseudo-inverse.
  kAsPrinted,
  // l_i / (l_i + ridge), the ridge by leave-one-out.
  kRidge,
  // Weighted partial least squares, a model of its own for each output (PLS1),
  // as each dof has its own "projections of the highest correlation". Leaving one
  // out takes the scores as given and so flatters it: best with num_components 1.
  kPartialLeastSquares,
  // The leading directions whole, the others not at all (Liu et al. 2011).
  kPrincipalComponents,
  // None: the weighted mean of the y_k.
  kMean,
};

// What the linear model is of. Without regularisation it makes no difference;
// a regularised model falls back to this when the inputs say little.
enum class RegressionTarget {
  kPose,          // y
  kChange,        // y - q_{t-1}
  kAcceleration,  // y - (2 q_{t-1} - q_{t-2}); wants m >= 2
};

struct LocalRegressionOptions {
  LocalRegressionMethod method = LocalRegressionMethod::kRidge;
  RegressionTarget target = RegressionTarget::kChange;
  // omega_k = exp(-|x_k - x|^2 / (2 h^2)), h = bandwidth times the distance of
  // the farthest neighbour, or bandwidth itself, in the units of x. The paper is
  // bandwidth 1 in the unstated unit of its angles.
  double bandwidth = 0.35;
  bool relative_bandwidth = true;
  // Frames. Where more than 0 the poses before the last one are told by their
  // velocities: x = [q_{t-1}; v (q_{t-1} - q_{t-2}); v (q_{t-2} - q_{t-3}) ...].
  // What moves how is a small part of what stands where, and a regularised model
  // of poses leaves the small parts out. Wants P = m D.
  double velocity_scale = 30.0;
  // Rows of that x are multiplied by these before anything else: W of Eq. (7) is
  // diag(row_scales)^2, and they are the metric of every method but kAsPrinted
  // with K > P. P numbers, or none for ones.
  Eigen::VectorXd row_scales;
  // For kPartialLeastSquares and kPrincipalComponents: 0 chooses by leave-one-out
  // from 0 ... max_components.
  int num_components = 0;
  int max_components = 8;
  // Standard deviations are not less than this, in the unit of y.
  double least_stddev = 1e-4;
  // Also return LocalPrediction::whitening; correlations are multiplied by
  // 1 - shrinkage.
  bool whitening = false;
  double shrinkage = 0.6;

  std::string Validate() const;  // empty, or which option is wrong and why
};

struct LocalPrediction {
  Eigen::VectorXd mean;  // D
  // D: root of the weighted mean square of the leave-one-out residuals. One
  // neighbour leaves nothing to judge by: least_stddev.
  Eigen::VectorXd stddev;
  // D x D, lower triangular, or empty: |whitening (y - mean)|^2 is the Mahalanobis
  // distance under the shrunk covariance of the leave-one-out residuals of all
  // dofs. Its inverse times its transposed inverse is that covariance, with
  // stddev^2 on the diagonal. Where a few dofs are observed, errors that go
  // together carry over to those that are not.
  Eigen::MatrixXd whitening;
  double ridge = 0.0;           // kRidge: what was chosen, in units of |x|^2
  int num_components = 0;       // the other methods: what was used
  double effective_dofs = 0.0;  // trace of the hat matrix, the mean's 1 included
};

// Keeps its storage: repeated calls of one size allocate nothing of their own.
// Cost O(K^2 (P + D) + K^3). The same input gives the same bytes.
class LocalRegression {
 public:
  // x: P x K, y: D x K, K >= 1, query: P; all finite. Throws InputError when the
  // sizes do not fit each other or the options.
  void Solve(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, const Eigen::VectorXd& query,
             const LocalRegressionOptions& options, LocalPrediction* prediction);

  // omega_k of the last Solve, of sum 1.
  Eigen::VectorXd weights() const { return root_weights_.cwiseAbs2(); }
  // Of the last Solve: column k is sqrt(omega_k) (y_k - what the model fitted to
  // the other neighbours says of it). D x K.
  const Eigen::MatrixXd& weighted_loo_residuals() const { return residuals_; }

 private:
  // Eq. (7), and x_ about the query.
  void Weigh(const Eigen::MatrixXd& x, const Eigen::VectorXd& query, Eigen::Index dofs,
             const LocalRegressionOptions& options);
  // Rotates the weighted columns so that the means stand in the first and K - 1
  // centred ones are left, then those to the eigenvectors of their Gram matrix.
  void Centre(const Eigen::MatrixXd& x, const Eigen::MatrixXd& y, RegressionTarget target);
  void Decompose();

  // By leave-one-out; they leave what they chose in use.
  double ChooseRidge();
  int ChooseLeading(const LocalRegressionOptions& options);
  // How much of each direction is used. Both return LeaveOneOut().
  double UseRidge(double ridge);
  double UseLeading(int count);
  // Sets residuals_ and returns their sum of squares.
  double LeaveOneOut();
  void PredictByDirections(LocalPrediction* prediction);

  void SolvePartialLeastSquares(const LocalRegressionOptions& options, LocalPrediction* prediction);
  // Sets mean, residuals_ and, for 0 ... count components, loo_squares_.
  void FitPartialLeastSquares(int count, LocalPrediction* prediction);
  void FindScores(Eigen::Index output);
  void SetDeviations(const LocalRegressionOptions& options, LocalPrediction* prediction);

  Eigen::VectorXd root_weights_;
  Eigen::MatrixXd x_, y_;  // P x K, D x K: weighted columns, then rotated ones
  Eigen::VectorXd reflector_, scratch_;
  double reflector_scale_ = 0.0;
  double reflected_mean_ = 1.0;  // the means are this times the first columns
  Eigen::MatrixXd gram_;
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen_;
  Eigen::VectorXd eigenvalues_;               // K - 1, ascending
  Eigen::MatrixXd directions_;                // K x K-1: eigenvectors, a row for each neighbour
  Eigen::MatrixXd targets_;                   // D x K-1
  Eigen::VectorXd query_;                     // K-1: the query's products with the inputs
  Eigen::VectorXd used_, left_;               // K-1: of each direction
  Eigen::VectorXd leverage_left_;             // K: 1 - the hat matrix' diagonal
  Eigen::MatrixXd targets_left_, residuals_;  // D x K-1, D x K
  Eigen::MatrixXd scores_, scores_at_neighbours_;     // K-1 x count, K x count
  Eigen::VectorXd score_, score_at_query_, loading_;  // K-1, count, count
  Eigen::VectorXd target_left_, output_left_;         // K-1, K
  Eigen::VectorXd loo_squares_;                       // count + 1
  Eigen::MatrixXd covariance_;                        // D x D
  Eigen::LLT<Eigen::MatrixXd> cholesky_;
};

}  // namespace poselift
