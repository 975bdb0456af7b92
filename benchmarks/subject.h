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
/// Adds --time and --rounds.
void add_options(CLI::App& app, eval::EqualTimeOptions& contest);
/// Adds --spp and --rounds, of contests at equal samples.
void add_sample_options(CLI::App& app, eval::EqualTimeOptions& contest);

/// A scene and the camera that it is seen by.
struct Subject {
    std::string name;  ///< of the file, without folder and ending
    Scene scene;
    CameraDesc camera;
    RenderOptions options;  ///< of bdpt

    /// The same for the library, as long as this object lives.
    [[nodiscard]] eval::BenchScene bench_scene() const;
};

/// The scene of a glTF file as its first camera sees it, or framed if it has none. Throws `Error`.
[[nodiscard]] Subject load_subject(const std::string& file, const SubjectSettings& settings);

/// Renders it by `eval::render_reference`, and says so on stdout.
[[nodiscard]] eval::Reference make_reference(const Subject& subject, std::int64_t samples);

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
