#define FIRN_REAL float
#define FIRN_DIMENSION 2
#include "engine/vector/targets/transfers.inl"
