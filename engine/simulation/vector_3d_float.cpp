#include "engine/simulation/make_vector.inl"

namespace firn {
template std::unique_ptr<Simulation> make_vector<float, 3>(const Plan&, std::span<const Seeds>, Isa);
}
