// The particles at the end of a run, as a child hands them to the study.
#pragma once

#include <filesystem>
#include <vector>

#include "engine/shapes/shape.h"

namespace firn {

/// Of one body, one entry a particle.
struct BodyPoints {
  std::vector<Vec3> start, displacement, velocity;  // m, m, m/s
  std::vector<Eigen::Matrix3d> stress;              // Pa, Cauchy's
  std::vector<double> mass;                         // kg

  explicit BodyPoints(std::size_t n = 0)
      : start(n), displacement(n), velocity(n), stress(n, Eigen::Matrix3d::Zero()), mass(n) {}
  std::size_t size() const { return mass.size(); }
};

/// Throws Error{io}. Not a format for others: only the program that wrote it reads it.
void write_points(const std::filesystem::path& file, const std::vector<BodyPoints>& bodies);
std::vector<BodyPoints> read_points(const std::filesystem::path& file);

}  // namespace firn
