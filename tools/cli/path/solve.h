// Roots of up to three equations in as many unknowns: the strains under which faces carry what they should.
#pragma once

#include <functional>

#include <Eigen/Core>

namespace firn {

using Residual = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

struct Root {
  Eigen::VectorXd x;
  double residual;  // its norm; infinite where nothing finite was found
};

/// The best that was found, from `guess` on. Both x and f are to be of order 1 or below: strains, and
/// stresses over a modulus; `elastic` is df/dx where nothing yields. Newton's steps with a numerical
/// derivative, shortened until they bring the residual down. At the kinks of a yield surface that derivative
/// is of neither side, and the elastic one takes its place; of one unknown the rest is done by bisection.
Root solve(const Residual& f, const Eigen::VectorXd& guess, const Eigen::MatrixXd& elastic);

/// x in [0, 1] where f is 0; f(0) and f(1) must not be of one sign.
double crossing(const std::function<double(double)>& f);

}  // namespace firn
