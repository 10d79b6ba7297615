#include "engine/simulation/make_plain.inl"

namespace firn {
template std::unique_ptr<Simulation> make_plain<float, 3>(const Plan&, std::span<const Seeds>);
}
