#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "materials/model_info.h"
#include "tools/cli/study/truth.h"

namespace firn {
namespace {

/// df at 0 of f(s), to the fourth order: for what varies like a sine over `h` / 3e-4, up to 60 of its
/// radians, to 4e-9, and with rounding of 1e-12.
template <class F>
Vec3 derivative(F&& f, double h) {
  return (8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h);
}
constexpr double kStep = 3e-4;

template <int D>
Eigen::Matrix3d cauchy(const Material& law, const Eigen::Matrix3d& F) {
  Eigen::Matrix3d out = Eigen::Matrix3d::Zero();
  std::visit(
      [&](const auto& model) {
        auto point = model.template at_rest<double, D>();
        for (int i = 0; i < D; ++i)
          for (int j = 0; j < D; ++j) point.F_E(i, j) = F(i, j);
        const auto tau = model.update(point, 0.0).tau;
        const double J = F.determinant();
        for (int i = 0; i < D; ++i)
          for (int j = 0; j < D; ++j) out(i, j) = tau(i, j) / J;
      },
      law);
  return out;
}

class ClosedFormTruth : public Truth {
 public:
  ClosedFormTruth(const ClosedForm& form, const Plan& plan, double time)
      : displacement_(form.displacement, kTruthNames), plan_(plan), time_(time) {
    for (const Quantity& q : form.displacement)
      text_ += fmt::format("{}{}", text_.empty() ? "displacement " : ", ",
                           q.formula.empty() ? fmt::format("{:g}", q.number) : q.formula);
  }

  std::vector<BodyPoints> at(const std::vector<BodyPoints>& run) const override {
    std::vector<BodyPoints> out;
    for (std::size_t b = 0; b < run.size(); ++b)
      out.push_back(at(run[b], plan_.batches[plan_.bodies[b].batch]));
    return out;
  }

  bool knows(StudyQuantity quantity) const override {
    // The stress of what has flowed is not the stress of its displacement.
    return quantity != kStress || std::all_of(plan_.batches.begin(), plan_.batches.end(), [](const auto& b) {
             return find_model(b.model)->yield == "none";
           });
  }
  double uncertainty(StudyQuantity) const override { return 0; }
  std::optional<double> order(StudyQuantity) const override { return std::nullopt; }
  std::string text() const override { return text_; }

 private:
  Vec3 displacement(const Vec3& X, double t) const {
    const auto u = displacement_(std::array{X[0], X[1], X[2], t});
    return {u[0], u[1], u[2]};
  }

  BodyPoints at(const BodyPoints& run, const BatchPlan& batch) const {
    BodyPoints out(run.size());
    out.start = run.start;
    out.mass = run.mass;
    Eigen::AlignedBox3d box;
    for (const Vec3& X : run.start) box.extend(X);
    const double length = kStep * box.diagonal().norm();
    const int D = plan_.dimension();
    for (std::size_t p = 0; p < run.size(); ++p) {
      const Vec3& X = run.start[p];
      out.displacement[p] = displacement(X, time_);
      out.velocity[p] = derivative([&](double s) { return displacement(X, time_ + s); }, kStep * time_);
      Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
      for (int j = 0; j < D; ++j)
        F.col(j) += derivative([&](double s) { return displacement(X + s * Vec3::Unit(j), time_); }, length);
      out.stress[p] = D == 1   ? cauchy<1>(batch.law, F)
                      : D == 2 ? cauchy<2>(batch.law, F)
                               : cauchy<3>(batch.law, F);
    }
    return out;
  }

  VectorFormula displacement_;
  const Plan& plan_;
  double time_;
  std::string text_;
};

}  // namespace

std::unique_ptr<Truth> closed_form_truth(const ClosedForm& form, const Plan& plan, double time) {
  return std::make_unique<ClosedFormTruth>(form, plan, time);
}

}  // namespace firn
