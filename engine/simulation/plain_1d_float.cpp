#include "engine/simulation/make_plain.inl"

namespace firn {
template std::unique_ptr<Simulation> make_plain<float, 1>(const Plan&, std::span<const Seeds>);
}
