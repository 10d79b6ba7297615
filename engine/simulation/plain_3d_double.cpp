#include "engine/simulation/make_plain.inl"

namespace firn {
template std::unique_ptr<Simulation> make_plain<double, 3>(const Plan&, std::span<const Seeds>);
}
