#define FIRN_REAL double
#define FIRN_DIMENSION 3
#include "engine/vector/targets/materials.inl"
