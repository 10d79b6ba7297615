// The scene format: every key with its type, range, unit and meaning, said once. The reader, the schema and
// the example scene are visitors of these functions, so they cannot disagree. A key's default is its member's
// initial value in description.h. What ties several keys together stands in checks.cpp.
#pragma once

#include <array>
#include <type_traits>

#include "engine/scene/description.h"
#include "engine/scene/field.h"

namespace firn {

inline constexpr std::array<Choice<KernelName>, 4> kKernels = {{
    {"quadratic", KernelName::quadratic, "B-spline over 3 nodes an axis: the fast path"},
    {"cubic", KernelName::cubic, "B-spline over 4 nodes: smoother, slower"},
    {"linear", KernelName::linear,
     "2 nodes: the original, noisy where particles cross cells; flip and pic only"},
    {"gimp", KernelName::gimp, "the linear one averaged over the particle; flip and pic only"},
}};
inline constexpr std::array<Choice<StressOrder>, 3> kStressOrders = {{
    {"usl", StressOrder::usl, "after the particles have moved: damps a little"},
    {"usf", StressOrder::usf, "before the forces: keeps energy"},
    {"musl", StressOrder::musl, "after, from the new velocities put on the grid once more"},
}};
inline constexpr std::array<Choice<Transfer>, 4> kTransfers = {{
    {"apic", Transfer::apic, "affine: keeps angular momentum, quiet"},
    {"mls", Transfer::mls, "APIC with forces from its moments: fastest"},
    {"flip", Transfer::flip, "keeps detail, noisier; see flip_ratio"},
    {"pic", Transfer::pic, "very dissipative"},
}};
inline constexpr std::array<Choice<Precision>, 2> kPrecisions = {{
    {"float", Precision::single, "32 bits"},
    {"double", Precision::double_, "64 bits"},
}};
inline constexpr std::array<Choice<PathChoice>, 2> kPaths = {{
    {"automatic", PathChoice::automatic, "vectorised where there is such a path"},
    {"plain", PathChoice::plain, "the reference, some twenty times slower"},
}};
inline constexpr std::array<Choice<Sampling>, 3> kSamplings = {{
    {"jittered", Sampling::jittered, "one particle in each part of a cell, at random in it"},
    {"lattice", Sampling::lattice, "one in the middle of each part: for comparison with other programs"},
    {"poisson", Sampling::poisson, "at random with a least distance: more even, slower to make"},
}};
inline constexpr std::array<Choice<Contact>, 3> kContacts = {{
    {"sticky", Contact::sticky, "moves with the surface"},
    {"slip", Contact::slip, "slides along it and never leaves it"},
    {"separating", Contact::separating, "slides along it and may leave it"},
}};

inline constexpr std::array<Choice<SolidPixels>, 2> kSolidPixels = {{
    {"bright", SolidPixels::bright, "at or above the threshold"},
    {"dark", SolidPixels::dark, "at or below it"},
}};

/// A description with every key at its default (Eigen leaves a plain Vec3{} uninitialised).
template <class T>
T defaults_of() {
  if constexpr (std::is_same_v<T, Vec3>) {
    return Vec3::Zero();
  } else {
    return {};
  }
}

template <class V>
void fields(V& v, SimulationDescription& d) {
  using enum Need;
  v.integer({"dimension", optional, "axes in use: x, then y, then z"}, d.dimension, {1, 3});
  v.real({"cell_size", required, "edge of a grid cell", "m"}, d.cell_size, kPositive);
  v.real({"duration", required, "simulated time", "s"}, d.duration, kPositive);
  v.real({"frame_rate", optional, "frames per simulated second", "1/s"}, d.frame_rate, kPositive);
  v.choice({"kernel", optional, "shape function of a grid node"}, d.kernel, kKernels);
  v.choice({"transfer", optional, "how velocity goes from the grid to the particles"}, d.transfer,
           kTransfers);
  v.real({"flip_ratio", optional,
          "with transfer \"flip\" only: 0 is PIC, 1 keeps every increment; 0.99 if left out", "-", "0.99"},
         d.flip_ratio, kFraction);
  v.choice({"stress_order", optional, "when in a step the stress is updated"}, d.stress_order, kStressOrders);
  v.choice({"precision", optional, "of the particles and the grid"}, d.precision, kPrecisions);
  v.choice({"path", optional, "of computation"}, d.path, kPaths);
  v.real({"cfl", optional, "time step as a part of the largest explicit one"}, d.cfl,
         {.min = 0, .max = 1, .min_open = true});
  v.real({"max_dt", optional, "longest time step", "s", "1e-3"}, d.max_dt, kPositive);
  v.real(
      {"mass_cutoff", optional,
       "nodes lighter than so many particles are ignored, with their momentum; if left out 1e-4 with kernel "
       "\"linear\" and stress_order \"usl\", else 0",
       "-", "1e-4"},
      d.mass_cutoff, kFraction);
  v.integer({"seed", optional, "of every random number"}, d.seed, {0});
}

/// [gravity] holds one vector.
template <class V>
void fields(V& v, Vec3& gravity) {
  v.vector({"acceleration", Need::required, "on every particle", "m/s^2"}, gravity);
}

template <class V>
void fields(V& v, BodyForceDescription& d) {
  v.quantities(
      {"acceleration", Need::required,
       "of every particle; each a number or a formula of its place x, y, z, its place X, Y, Z at the "
       "start, and the time t",
       "m/s^2"},
      d.acceleration, kForceNames);
}

/// In place of a material's model: a preset, which has one.
inline constexpr std::string_view kPresetKey = "preset";

template <class V>
void fields(V& v, MaterialDescription& d) {
  v.model({"model", Need::required, "one of those that 'firn materials' lists"}, d);
}

template <class V>
void fields(V& v, SphereDescription& d) {
  v.vector({"center", Need::required, "center", "m"}, d.center);
  v.real({"radius", Need::required, "radius", "m"}, d.radius, kPositive);
}

template <class V>
void fields(V& v, BoxDescription& d) {
  v.vector({"min", Need::required, "lowest corner", "m"}, d.min);
  v.vector({"max", Need::required, "highest corner", "m"}, d.max);
}

template <class V>
void fields(V& v, CylinderDescription& d) {
  v.vector({"start", Need::required, "center of one cap", "m"}, d.start);
  v.vector({"end", Need::required, "center of the other cap", "m"}, d.end);
  v.real({"radius", Need::required, "radius", "m"}, d.radius, kPositive);
}

template <class V>
void fields(V& v, ConeDescription& d) {
  v.vector({"base", Need::required, "center of the base", "m"}, d.base);
  v.vector({"apex", Need::required, "tip", "m"}, d.apex);
  v.real({"radius", Need::required, "radius of the base", "m"}, d.radius, kPositive);
}

template <class V>
void fields(V& v, PlaneDescription& d) {
  v.vector({"point", Need::required, "any point of the plane", "m"}, d.point);
  v.vector({"normal", Need::required, "points out of the solid side; of any length"}, d.normal);
}

template <class V>
void fields(V& v, MeshDescription& d) {
  v.file({"file", Need::required, "closed triangle mesh (OBJ, PLY, STL, glTF, ...), relative to the scene"},
         d.file);
}

template <class V>
void fields(V& v, LevelSetDescription& d) {
  v.file({"file", Need::required, "OpenVDB file, relative to the scene"}, d.file);
  v.text({"grid", Need::optional,
          "name of a level set or fog volume in it; if left out the first level set, or with a threshold or "
          "without any level set the first fog volume"},
         d.grid);
  v.real({"threshold", Need::optional, "least density of a fog volume that is solid; 0.5 if left out", "-",
          "0.5"},
         d.threshold, kPositive);
}

template <class V>
void fields(V& v, ImageDescription& d) {
  using enum Need;
  v.file({"file", required,
          "PNG or PGM, relative to the scene; \"slice.####.png\" is a stack of slices along z, numbered"},
         d.file);
  v.vector({"size", required, "that it fills from its lower corner, the origin: across, up and along z", "m"},
           d.size);
  v.real({"threshold", optional, "where solid begins, between black (0) and white (1)"}, d.threshold,
         kFraction);
  v.choice({"solid", optional, "which pixels are solid"}, d.solid, kSolidPixels);
}

template <class V>
void fields(V& v, CombinationDescription& d) {
  v.shapes({"of", Need::required, "two shapes or more"}, d.operands);
}

template <class V>
void fields(V& v, ShapeDescription& d) {
  using enum Need;
  v.kind({"type", required, "of solid"}, d.kind);
  v.real({"scale", optional, "size, about the shape's own origin; applied first"}, d.scale, kPositive);
  v.vector({"rotate", optional, "about x, then y, then z; applied second", "degrees"}, d.rotate, Axes::about);
  v.vector({"translate", optional, "applied last", "m"}, d.translate);
}

template <class V>
void fields(V& v, BodyDescription& d) {
  using enum Need;
  v.text({"name", required, "unique among the bodies"}, d.name);
  v.name({"material", required, "name of a [materials.NAME]"}, d.material);
  v.shape({"shape", optional, "filled with particles; this or points"}, d.shape);
  v.file({"points", optional, "CSV or PLY file of particles, relative to the scene; this or shape", "-",
          "\"grains.csv\""},
         d.points);
  v.choice({"sampling", optional, "how a shape is filled"}, d.sampling, kSamplings);
  v.real({"particles_per_cell", optional, "in a full cell"}, d.particles_per_cell,
         {.min = 0, .max = 1000, .min_open = true});
  v.quantities({"velocity", optional, "at the start; each a number or a formula of x, y, z", "m/s"},
               d.velocity, kPlaceNames);
  v.vector({"angular_velocity", optional, "at the start, about the center of mass", "degrees/s"},
           d.angular_velocity, Axes::about);
}

/// How a surface acts on the material; the same for colliders and for the walls of the domain.
template <class V, class D>
void contact_fields(V& v, D& d) {
  v.choice({"contact", Need::optional, "what material does that meets the surface"}, d.contact, kContacts);
  v.real({"friction", Need::optional, "Coulomb's coefficient; not with \"sticky\""}, d.friction,
         kNotNegative);
}

template <class V>
void fields(V& v, KeyFrame& d) {
  v.real({"time", Need::required, "later than that of the key frame before", "s"}, d.time, kAnyNumber);
  v.vector({"position", Need::optional, "of the shape's own origin", "m"}, d.position);
  v.vector({"rotation", Need::optional, "about x, then y, then z", "degrees"}, d.rotation, Axes::about);
}

template <class V>
void fields(V& v, ColliderDescription& d) {
  v.text({"name", Need::required, "unique among the colliders"}, d.name);
  v.shape({"shape", Need::required, "the solid part"}, d.shape);
  contact_fields(v, d);
  v.list({"keyframes", Need::optional, "its motion, linear in between; at rest if left out"}, d.keyframes);
}

template <class V>
void fields(V& v, LoadDescription& d) {
  using enum Need;
  v.text({"name", required, "unique among the loads"}, d.name);
  v.shape({"region", required, "acts on the particles that start in it"}, d.region);
  v.quantities({"force", required,
                "on all of them together, shared by mass; each a number or a formula as of body_force", "N"},
               d.force, kForceNames);
}

template <class V>
void fields(V& v, DomainDescription& d) {
  v.vector({"min", Need::required, "lowest corner", "m"}, d.min);
  v.vector({"max", Need::required, "highest corner", "m"}, d.max);
  contact_fields(v, d);
}

template <class V>
void fields(V& v, OutputDescription& d) {
  v.attributes({"attributes", Need::optional, "of every particle, beside P, v, id and pscale"}, d.attributes);
}

template <class V>
void fields(V& v, SceneDescription& d) {
  using enum Need;
  v.text({"title", optional, "one line"}, d.title);
  v.text({"description", optional, "what it shows and what the right answer looks like"}, d.description);
  v.section({"simulation", required, "the method and its accuracy"}, d.simulation);
  v.section({"gravity", optional, "none if left out"}, d.gravity);
  v.section({"body_force", optional, "one that varies; none if left out"}, d.body_force);
  v.materials({"materials", required, "[materials.NAME], one for each material"}, d.materials);
  v.list({"bodies", required, "what is simulated"}, d.bodies);
  v.list({"colliders", optional, "what the bodies run into"}, d.colliders);
  v.list({"loads", optional, "forces on parts of bodies"}, d.loads);
  v.section({"domain", optional, "a box whose walls hold the material; open if left out"}, d.domain);
  v.section({"output", optional, "what the frames hold"}, d.output);
}

}  // namespace firn
