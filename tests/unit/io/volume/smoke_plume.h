#pragma once

#include <openvdb/openvdb.h>

namespace bdpt::test {

/// scenes/smoke.vdb: a plume that rises along y from the block of scenes/room-spot.gltf, 1.2 m
/// high, of densities up to 1 in half precision.
openvdb::FloatGrid::Ptr smoke_plume();

}  // namespace bdpt::test
