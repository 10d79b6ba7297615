#include "tools/cli/path/solve.h"

#include <cmath>
#include <limits>

#include <Eigen/LU>

namespace firn {
namespace {

constexpr double kGoal = 1e-14;        // round-off of stresses over their modulus
constexpr double kGoodEnough = 1e-10;  // not worth a bisection
constexpr double kProbe = 1e-8;        // of the derivative: the root of round-off
constexpr double kLongest = 0.1;       // strain of one step

double size(const Eigen::VectorXd& r) {
  return r.allFinite() ? r.norm() : std::numeric_limits<double>::infinity();
}

Eigen::MatrixXd numerical_slope(const Residual& f, const Eigen::VectorXd& x, const Eigen::VectorXd& r) {
  Eigen::MatrixXd slope(r.size(), x.size());
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    Eigen::VectorXd probe = x;
    probe[j] += kProbe;
    slope.col(j) = (f(probe) - r) / kProbe;
  }
  return slope;
}

/// A part of Newton's step from x, where f is r; moves both. False where no part of it is better.
bool advance(const Residual& f, const Eigen::MatrixXd& slope, Eigen::VectorXd& x, Eigen::VectorXd& r) {
  constexpr int kHalvings = 30;
  Eigen::VectorXd step = -slope.fullPivLu().solve(r);
  if (!step.allFinite()) return false;
  const double longest = step.cwiseAbs().maxCoeff();
  if (longest > kLongest) step *= kLongest / longest;
  double part = 1;
  for (int k = 0; k < kHalvings; ++k, part /= 2) {
    const Eigen::VectorXd next = x + part * step, r_next = f(next);
    if (!(size(r_next) < (1 - 1e-4 * part) * size(r))) continue;
    x = next, r = r_next;
    return true;
  }
  return false;
}

Root newton(const Residual& f, Eigen::VectorXd x, const Eigen::MatrixXd& elastic) {
  constexpr int kSteps = 60;
  Eigen::VectorXd r = f(x);
  for (int n = 0; n < kSteps && size(r) > kGoal; ++n)
    if (!advance(f, numerical_slope(f, x, r), x, r) && !advance(f, elastic, x, r)) break;
  return {x, size(r)};
}

/// Between a and b, where f has the values f_a and f_b of different sign.
double bisect(const std::function<double(double)>& f, double a, double f_a, double b, double f_b) {
  for (int n = 0; n < 200 && f_a != 0 && f_b != 0; ++n) {
    // The secant's root every other time: fast where f is smooth, never slower than twice a bisection.
    const double secant = a - f_a * (b - a) / (f_b - f_a), middle = 0.5 * (a + b);
    const double x = n % 2 == 0 && std::isfinite(secant) ? secant : middle;
    if (x == a || x == b) {
      if (n % 2 == 1) break;
      continue;
    }
    const double f_x = f(x);
    if ((f_x > 0) == (f_a > 0) && f_x != 0) {
      a = x, f_a = f_x;
    } else {
      b = x, f_b = f_x;
    }
  }
  return std::abs(f_a) < std::abs(f_b) ? a : b;
}

/// Farther and farther around x, until f changes its sign.
Root search(const Residual& residual, double x) {
  const auto at = [](double value) { return Eigen::VectorXd(Eigen::VectorXd::Constant(1, value)); };
  const auto f = [&](double value) { return residual(at(value))[0]; };
  const double f_x = f(x);
  for (double reach = 1e-9; reach < 10; reach *= 2)
    for (const double end : {x + reach, x - reach}) {
      const double f_end = f(end);
      if (!std::isfinite(f_end) || (f_end > 0) == (f_x > 0)) continue;
      const Eigen::VectorXd root = at(bisect(f, x, f_x, end, f_end));
      return {root, size(residual(root))};
    }
  return {at(x), std::abs(f_x)};
}

}  // namespace

Root solve(const Residual& f, const Eigen::VectorXd& guess, const Eigen::MatrixXd& elastic) {
  if (guess.size() == 0) return {guess, 0};
  Root root = newton(f, guess, elastic);
  if (root.residual < kGoodEnough || guess.size() > 1) return root;
  const Root other = search(f, guess[0]);
  return other.residual < root.residual ? other : root;
}

double crossing(const std::function<double(double)>& f) {
  return bisect(f, 0, f(0), 1, f(1));
}

}  // namespace firn
