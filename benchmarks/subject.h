#pragma once

#include <bdpt/image.h>
#include <bdpt/render.h>

#include <cstdint>
#include <exception>
#include <string>

namespace CLI {
class App;
}

namespace bdpt {

/// Which scene is rendered, and how: what the benchmarks of renders have in common.
struct SubjectSettings {
    std::string environment{};              ///< file; empty: only what the scene brings
    int size = 128;                         ///< width and height [pixels]
    int max_depth = 8;                      ///< longest path in edges
    int threads = 1;                        ///< 0: one for each hardware thread
    std::int64_t reference_samples = 2048;  ///< per pixel
};

/// Adds --env, --size, --max-depth and --threads.
void add_options(CLI::App& app, SubjectSettings& settings);
/// Adds --reference.
void add_reference_option(CLI::App& app, SubjectSettings& settings);

/// A scene and the camera that it is seen by.
struct Subject {
    std::string name;  ///< of the file, without folder and ending
    Scene scene;
    CameraDesc camera;
    RenderOptions options;  ///< of bdpt
};

/// The scene of a glTF file as its first camera sees it, or framed if it has none. Throws `Error`.
[[nodiscard]] Subject load_subject(const std::string& file, const SubjectSettings& settings);

/// What a picture converges to, as well as it is known.
struct Reference {
    Image image;
    double noise = 0.0;  ///< relMSE of `image`, from its two independent halves
};

/// Renders it by bdpt with a seed that no trial has, and says so on stdout.
[[nodiscard]] Reference make_reference(const Subject& subject, std::int64_t samples);

/// relMSE of `film` without the reference's own noise, which adds to that of every picture.
[[nodiscard]] double error_of(const Film& film, const Reference& reference);

/// On stderr.
void print_error(const std::exception& error);

/// What `body` returns; 1, with a message, when it throws. The rest of main().
template <typename Body>
[[nodiscard]] int report_errors(const Body& body)
{
    try {
        return body();
    } catch (const std::exception& error) {
        print_error(error);
        return 1;
    }
}

}  // namespace bdpt
