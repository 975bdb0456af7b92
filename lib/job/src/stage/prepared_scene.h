#pragma once

#include <bdpt/default_lights.h>
#include <bdpt/io/gltf.h>
#include <bdpt/light_desc.h>
#include <bdpt/render_options.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "messages/console.h"
#include "options/groups/view_arguments.h"
#include "options/render_arguments.h"
#include "options/value_types.h"

namespace bdpt::job {

/// A scene with light and a camera, ready to render.
struct PreparedScene {
    Scene scene;
    CameraDesc camera;  ///< with its name or index, or "auto"
    /// For people: its file, "scene", "default", "object", "studio" or "none".
    std::string environment_name;
    Size size;
    std::vector<std::string> warnings;  ///< one line each
    std::vector<Note> notes{};          ///< additions to a file that lacks something
    double load_seconds = 0.0;          ///< reading files
    double build_seconds = 0.0;         ///< building the scene
    io::GltfFacts facts{};              ///< about the whole file
    /// Lights of the file and of --env, without those added to a dark scene.
    std::size_t lights = 0;
    bool has_object_light = false;               ///< it got the light of objects without lights
    bool is_framed = false;                      ///< the camera is not one of the file
    std::vector<CameraDesc> cameras{};           ///< those of the scene
    std::vector<std::filesystem::path> files{};  ///< that the scene names
    io::MemoryBudget memory;                     ///< the scene's memory is already charged
};

/// Returns "36 triangles (2 emissive), 1 light".
[[nodiscard]] std::string size_text(const PreparedScene& stage);

/// Returns the word of --env for the environment among default lights.
[[nodiscard]] const char* environment_name(DefaultLights lights);
/// Returns that environment as people call it: "a soft sky".
[[nodiscard]] const char* environment_text(DefaultLights lights);

/// Tests whether files for screens show the shadow of the scene on the ground though it was not
/// requested.
[[nodiscard]] bool adds_ground(const RenderArguments& arguments, const PreparedScene& stage);

/// Returns `arguments` with `aov` in the film, for files for screens alone.
[[nodiscard]] RenderArguments with_screen_aov(RenderArguments arguments, Aov aov);

/// Tests whether an environment lights the scene.
[[nodiscard]] bool has_environment(const PreparedScene& stage);

/// Returns `light` rotated and scaled.
[[nodiscard]] EnvironmentLightDesc changed(EnvironmentLightDesc light,
                                           const EnvironmentChange& change);

/// A camera and the size of its image.
struct Viewpoint {
    CameraDesc camera;  ///< with its name or index
    Size size;
    bool is_framed = false;  ///< the camera is not one of the file
    bool is_inside = false;  ///< it is framed from inside of a closed room
};

/// Loads the file, and fills in defaults by the rules that `bdpt render --help` states. Memory is
/// charged to `arguments.scene.memory`, or to `arguments.memory` if there is none. Throws `Error`.
[[nodiscard]] PreparedScene prepare_scene(const RenderArguments& arguments);

/// Returns camera `index` of the scene, with the view and the lens of `arguments`. Throws `Error`.
[[nodiscard]] Viewpoint viewpoint(const PreparedScene& stage, std::size_t index,
                                  const RenderArguments& arguments);

/// Returns the view of the camera that `arguments` choose; it may be framed for another size than
/// before. Throws `Error`.
[[nodiscard]] Viewpoint viewpoint(const PreparedScene& stage, const RenderArguments& arguments);

/// Returns the names of the cameras, or their indices if they have none.
[[nodiscard]] std::vector<std::string> camera_names(const PreparedScene& stage);

/// Returns the share of the image that surfaces fill, in [0, 1]. `aspect` is width over height.
/// Throws `Error` for a camera that is too far away to render.
[[nodiscard]] double filled_share(const Scene& scene, const CameraDesc& camera, float aspect);

/// Returns the camera of `image`, one of a sequence, which orbits on request; else `first`, the one
/// that the scene was loaded with. Throws `Error`.
[[nodiscard]] Viewpoint sequence_viewpoint(const PreparedScene& stage, const Viewpoint& first,
                                           const RenderArguments& image);

/// Returns `still` for a view of a turntable at `angle` [rad] around the object, with the
/// environment turned along with the camera.
[[nodiscard]] Scene with_turned_environment(const Scene& still, double angle);

/// Returns all files that `arguments` read: no output may be one of them.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const RenderArguments& arguments);

/// Returns all files that `arguments` and the scene read.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const RenderArguments& arguments,
                                                             const PreparedScene& stage);

/// Returns the files that the scene names, by its text alone: for outputs that are written before
/// it is loaded. Empty if none of `outputs` exists, as none can then be one of them, or if the
/// scene cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> named_files(
    const RenderArguments& arguments, std::span<const std::filesystem::path> outputs);

/// Returns the memory for decoded images kept between frames [bytes]: a quarter of the limit, but
/// not more than 2 GiB.
[[nodiscard]] std::uint64_t image_cache_bytes(const RenderArguments& arguments);

/// Loads the scene, and shows the progress on the console. Throws `Error`.
[[nodiscard]] PreparedScene prepare_with_progress(RenderArguments arguments, Console& console);

/// Prints warnings and notes from the preparation of the scene, each once.
void tell_findings(Console& console, const PreparedScene& stage);

/// Prints notes about options that change nothing: those of files that are not written, and a
/// ground whose shadow is not visible.
void tell_of_no_effect(Console& console, const RenderArguments& arguments,
                       const PreparedScene& stage);

/// Charges the memory of the film of a render of `size` and its layers. Throws `Error` if that is
/// too much.
void spend_film(io::MemoryBudget& memory, const RenderOptions& options, const Size& size);

/// Charges the memory of the shadow on the ground for the film of `arguments`, which lack it.
/// Throws `Error` if that is too much.
void spend_ground(io::MemoryBudget& memory, const RenderArguments& arguments);

/// Returns the layers that guide automatic denoising and that `arguments` do not ask for, and
/// charges their memory; none if that would leave too little for the denoiser. A part has no
/// further layers.
[[nodiscard]] std::optional<std::vector<Aov>> spend_guides(io::MemoryBudget& memory,
                                                           const RenderArguments& arguments);

/// Loads the scene within the memory that the film and the cache of images, if any, leave of
/// `arguments.memory`, and shows the progress on the console. Throws `Error`.
[[nodiscard]] PreparedScene prepare_within_memory(const RenderArguments& arguments,
                                                  Console& console);

/// Estimates the fraction of the light, in [0, 1], that is lost by the maximum depth of
/// `arguments`, which have all their options; 0 if it is below 1 % or if only emitted and direct
/// light is requested. By a short render.
[[nodiscard]] double light_beyond_max_depth(const RenderArguments& arguments,
                                            const PreparedScene& stage);

/// Tests whether the light is metered for the exposure of images: if `--exposure light` says so,
/// with a background and for frames; and, unless another exposure is requested, if an environment
/// lights the scene and the camera is outside of it.
[[nodiscard]] bool meters_light(const RenderArguments& arguments, const PreparedScene& stage);

/// Returns the exposure [EV] that makes a white card white that lies on the surfaces that the view
/// of `arguments` shows without --size, whatever the size of the image; none if no light falls on
/// it.
[[nodiscard]] std::optional<float> metered_exposure(const PreparedScene& stage,
                                                    RenderArguments arguments);
/// The same for a view of the scene, with an image of `size`.
[[nodiscard]] std::optional<float> metered_exposure(const Scene& scene, const CameraDesc& camera,
                                                    const Size& size);

/// Completes the options of `arguments`: fills in size, samples and limits of memory, chooses open
/// options by a pilot, and adds sample rates from a file or another pilot, unless they have them
/// already. A request of `abandon` ends the first pilot early; the result is then invalid. Throws
/// `Error`.
[[nodiscard]] RenderArguments with_choice(RenderArguments arguments, const PreparedScene& stage,
                                          Console& console, const std::stop_token& abandon = {});

}  // namespace bdpt::job
