// A scene as the user wrote it: plain values in SI units (angles in degrees, as in the file). What the scene
// leaves out is empty. Nothing is resolved: names are still names, each with the place it was written at.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "engine/base/problems.h"
#include "engine/base/vector_formula.h"
#include "engine/effects/contact.h"
#include "engine/shapes/image.h"
#include "engine/shapes/shape.h"

namespace firn {

/// A name that the plan resolves, and where it stands.
struct Name {
  std::string text;
  SourceMark mark;
};

/// What a formula can depend on: the place at the start, or in a force the place now, that at the start, and
/// the time.
inline constexpr std::array<std::string_view, 3> kPlaceNames = {"x", "y", "z"};
inline constexpr std::array<std::string_view, 7> kForceNames = {"x", "y", "z", "X", "Y", "Z", "t"};

struct ShapeDescription;

struct SphereDescription {
  Vec3 center = Vec3::Zero();
  double radius = 0;
};
struct BoxDescription {
  Vec3 min = Vec3::Zero(), max = Vec3::Zero();
};
struct CylinderDescription {
  Vec3 start = Vec3::Zero(), end = Vec3::Zero();
  double radius = 0;
};
struct ConeDescription {
  Vec3 base = Vec3::Zero(), apex = Vec3::Zero();
  double radius = 0;
};
// Solid on the side the normal points away from.
struct PlaneDescription {
  Vec3 point = Vec3::Zero(), normal = Vec3::Zero();
};
struct MeshDescription {
  Name file;
};  // any format assimp reads
struct LevelSetDescription {
  Name file;
  std::string grid;                 // empty: the first that fits
  std::optional<double> threshold;  // fog volumes only: solid is what is at least as dense
};                                  // .vdb
struct ImageDescription {
  Name file;                 // PNG or PGM; with a run of '#' for the number, a stack of them
  Vec3 size = Vec3::Zero();  // m; z is 0 in a plane scene
  double threshold = 0.5;    // of the full range
  SolidPixels solid = SolidPixels::bright;
};  // with its lower corner at the origin
struct CombinationDescription {
  enum class Operation { unite, subtract, intersect } operation;  // subtract: the first less all others
  std::vector<ShapeDescription> operands;
};

struct ShapeDescription {
  using Kind =
      std::variant<SphereDescription, BoxDescription, CylinderDescription, ConeDescription, PlaneDescription,
                   MeshDescription, LevelSetDescription, ImageDescription, CombinationDescription>;
  Kind kind;
  SourceMark mark;
  // Applied in this order: scale, rotate (about x, then y, then z), translate.
  double scale = 1;
  Vec3 rotate = Vec3::Zero();     // degrees
  Vec3 translate = Vec3::Zero();  // m
};

enum class Sampling { jittered, lattice, poisson };

struct BodyDescription {
  std::string name;
  SourceMark mark;
  Name material;
  std::optional<ShapeDescription> shape;  // this or points
  std::optional<Name> points;             // CSV or PLY file of positions (and optionally velocities)
  Sampling sampling = Sampling::jittered;
  double particles_per_cell = 8;
  VectorQuantity velocity;               // m/s, of kPlaceNames
  Vec3 angular_velocity = Vec3::Zero();  // degrees/s about the body's centre of mass
};

/// A material as named values; the registry knows which model takes which.
struct MaterialDescription {
  struct Value {
    std::variant<double, bool, std::string> value;
    SourceMark mark;
  };
  std::string name;
  SourceMark mark;
  Name model;
  std::map<std::string, Value> parameters;  // density among them
};

struct KeyFrame {
  double time = 0;               // s
  Vec3 position = Vec3::Zero();  // m
  Vec3 rotation = Vec3::Zero();  // degrees about x, then y, then z
};

struct ColliderDescription {
  std::string name;
  SourceMark mark;
  ShapeDescription shape;
  Contact contact = Contact::separating;
  double friction = 0;              // Coulomb, for slip and separating
  std::vector<KeyFrame> keyframes;  // empty: static; moves the shape about its own origin
};

struct BodyForceDescription {
  VectorQuantity acceleration;  // m/s^2, of kForceNames
};

/// A force that the particles which start in `region` share by their mass.
struct LoadDescription {
  std::string name;
  SourceMark mark;
  ShapeDescription region;
  VectorQuantity force;  // N, of kForceNames
};

struct DomainDescription {
  Vec3 min = Vec3::Zero(), max = Vec3::Zero();
  Contact contact = Contact::separating;
  double friction = 0;
};

enum class KernelName { linear, gimp, quadratic, cubic };
enum class Transfer { pic, flip, apic, mls };
/// When F and with it the stress are brought up to date: before the step's forces, after the particles have
/// moved, or after that from their new velocities on the grid.
enum class StressOrder { usf, usl, musl };
enum class Precision { single, double_ };
enum class PathChoice { automatic, plain };

struct SimulationDescription {
  int dimension = 3;
  double cell_size = 0;  // m
  double duration = 0;   // s
  double frame_rate = 24;
  KernelName kernel = KernelName::quadratic;
  Transfer transfer = Transfer::apic;
  std::optional<double> flip_ratio;  // flip only; 0 is PIC, 1 keeps every increment
  StressOrder stress_order = StressOrder::usl;
  Precision precision = Precision::single;
  PathChoice path = PathChoice::automatic;
  double cfl = 0.4;
  std::optional<double> max_dt;       // s
  std::optional<double> mass_cutoff;  // parts of the lightest particle's mass; see mass_cutoff() in plan.h
  std::uint64_t seed = 1;
};

struct OutputDescription {
  std::vector<Name> attributes;  // beside P v id pscale
};

struct SceneDescription {
  std::filesystem::path file;
  std::string as_run;  // the scene as TOML, overrides in it: what it takes to run it again
  std::string title, description;
  SimulationDescription simulation;
  std::optional<Vec3> gravity;  // m/s^2
  std::optional<BodyForceDescription> body_force;
  std::vector<LoadDescription> loads;
  std::vector<MaterialDescription> materials;
  std::vector<BodyDescription> bodies;
  std::vector<ColliderDescription> colliders;
  std::optional<DomainDescription> domain;
  OutputDescription output;

  bool names_forces() const { return body_force || !loads.empty(); }
};

}  // namespace firn
