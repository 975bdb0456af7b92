#pragma once

#include <bdpt/eval/bench/bench_scene.h>
#include <bdpt/eval/bench/equal_time.h>
#include <bdpt/eval/bench/reference.h>
#include <bdpt/render.h>

#include <cstdint>
#include <exception>
#include <string>

namespace CLI {
class App;
}

namespace bdpt {

/// Scene and render settings shared by the benchmarks of renders.
struct SubjectSettings {
    std::string environment{};              ///< file; empty: only the scene's own lights
    int size = 128;                         ///< width and height [pixels]
    int max_depth = 8;                      ///< maximum path length [edges]
    int threads = 1;                        ///< 0: one per hardware thread
    std::int64_t reference_samples = 2048;  ///< per pixel
};

/// Adds --env, --size, --max-depth and --threads.
void add_options(CLI::App& app, SubjectSettings& settings);
/// Adds --reference.
void add_reference_option(CLI::App& app, SubjectSettings& settings);
/// Adds --time and --rounds.
void add_options(CLI::App& app, eval::EqualTimeOptions& contest);
/// Adds --spp and --rounds, for comparisons at equal samples.
void add_sample_options(CLI::App& app, eval::EqualTimeOptions& contest);

/// A scene and its camera.
struct Subject {
    std::string name;  ///< name of the file, without folder and extension
    Scene scene;
    CameraDesc camera;
    RenderOptions options;  ///< options for bdpt

    /// Returns the scene for the library; valid during the lifetime of this object.
    [[nodiscard]] eval::BenchScene bench_scene() const;
};

/// Loads the scene of a glTF file with its first camera, or framed if it has none. Throws `Error`.
[[nodiscard]] Subject load_subject(const std::string& file, const SubjectSettings& settings);

/// Renders a reference by `eval::render_reference`, and says so on stdout.
[[nodiscard]] eval::Reference make_reference(const Subject& subject, std::int64_t samples);

/// Prints an error on stderr.
void print_error(const std::exception& error);

/// Returns the result of `body`; 1, with a message, if it throws. For main().
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
