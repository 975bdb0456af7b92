#pragma once

#include <bdpt/scene_desc.h>

#include <optional>
#include <string>
#include <vector>

namespace bdpt::test {

/// A scene in which some integrators can make exactly the same paths.
struct EqualityCase {
    std::string name;
    SceneDesc scene;
    CameraDesc camera;
    int max_depth = 4;
    /// `pt` and `mis` see delta lights through light sampling alone, so they miss what those cast
    /// through mirrors and glass: such scenes have other lights only.
    double detectable_bias = 0.035;
    /// For nee and lt, which some scenes make noisy.
    double detectable_bias_of_light_sampling = 0.035;
    /// `lt` sees all paths of this many edges and more: 2 where the sky can be seen, for no light
    /// path starts towards the lens there. None where camera rays can meet mirrors or smooth glass.
    std::optional<int> seen_by_lt = 1;
};

[[nodiscard]] std::vector<EqualityCase> equality_cases();
/// Those of them with surfaces that are not opaque or not lit.
[[nodiscard]] std::vector<EqualityCase> alpha_cases();

/// Scenes of so many lights that a tree chooses among them. Not among `equality_cases`.
[[nodiscard]] std::vector<EqualityCase> many_light_cases();
/// A luminaire with a measured profile, alone and among other lights. Not among `equality_cases`.
[[nodiscard]] std::vector<EqualityCase> profile_cases();
/// Textures that are looked up in smaller copies. Not among `equality_cases`.
[[nodiscard]] std::vector<EqualityCase> mip_map_cases();

/// Materials with layers and other extensions of glTF, one each. Not among `equality_cases`.
[[nodiscard]] std::vector<EqualityCase> layer_cases();
/// Sixty materials with random layers, in one scene. Not among `equality_cases` either.
[[nodiscard]] std::vector<EqualityCase> any_material_cases();
/// Bodies in bodies, and a camera in one. Not among `equality_cases` either.
[[nodiscard]] std::vector<EqualityCase> volume_cases();
/// Materials whose normal maps lean by up to 70 degrees. Not among `equality_cases` either.
[[nodiscard]] std::vector<EqualityCase> normal_map_cases();

/// Coarse meshes with smooth normals, which face away from the lens at silhouettes. Not among
/// `equality_cases` either.
[[nodiscard]] std::vector<EqualityCase> silhouette_cases();

/// Fog, and bodies that scatter within. Not among `equality_cases`.
[[nodiscard]] std::vector<EqualityCase> media_cases();

/// What moves while the shutter is open. Not among `equality_cases`.
[[nodiscard]] std::vector<EqualityCase> motion_cases();

}  // namespace bdpt::test
