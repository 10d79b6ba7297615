#define FIRN_REAL float
#define FIRN_DIMENSION 3
#include "engine/vector/targets/transfers.inl"
