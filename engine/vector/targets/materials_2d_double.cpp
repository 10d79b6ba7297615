#define FIRN_REAL double
#define FIRN_DIMENSION 2
#include "engine/vector/targets/materials.inl"
