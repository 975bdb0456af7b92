#pragma once

#include <bdpt/part/identity.h>
#include <bdpt/render_options.h>
#include <bdpt/scene_desc.h>

#include <vector>

namespace bdpt {

/// Adds what bits depend on: all of a camera but its name.
void add_camera(std::vector<IdentityComponent>& result, const CameraDesc& camera);

/// Adds all options that change bits of samples.
void add_options(std::vector<IdentityComponent>& result, const RenderOptions& options);

}  // namespace bdpt
