#pragma once

#include <bdpt/eval/bench.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace bdpt::eval {

/// File paths of the benchmark of one scene.
class BenchFiles {
public:
    BenchFiles(std::filesystem::path folder, std::string scene);

    [[nodiscard]] std::filesystem::path plan() const;
    [[nodiscard]] std::filesystem::path run(IntegratorKind integrator, std::uint64_t seed) const;
    [[nodiscard]] std::filesystem::path image(IntegratorKind integrator, std::uint64_t seed) const;
    [[nodiscard]] std::filesystem::path strategies() const;
    /// `key` distinguishes the references of a scene.
    [[nodiscard]] std::filesystem::path reference_image(const std::string& key) const;
    [[nodiscard]] std::filesystem::path reference_facts(const std::string& key) const;

    /// Creates the folders. Throws `Error` (output).
    void create() const;

private:
    std::filesystem::path folder_;
    std::string scene_;
};

/// Returns the settings that images of a scene depend on, apart from integrator, samples, seed and
/// machine: components of the render's identity, by name.
[[nodiscard]] nlohmann::ordered_json render_settings(const BenchScene& scene,
                                                     const RenderOptions& options);
/// Returns a hash of what is rendered: scene and camera.
[[nodiscard]] std::string hash_content(const BenchScene& scene);
/// Returns a content hash of 32 hexadecimal digits.
[[nodiscard]] std::string hash_bytes(std::string_view bytes);

/// Reads a JSON file; returns none if there is no such file. Throws `Error`: not_found if it cannot
/// be read, invalid_input if it is no JSON.
[[nodiscard]] std::optional<nlohmann::ordered_json> read_json(const std::filesystem::path& file);
/// Writes a JSON file atomically. Throws `Error` (output).
void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json);

/// Throws `Error` (invalid_input) for an image of another size.
void check_size(const Image& image, int width, int height, const std::filesystem::path& file);

/// Converts a run to JSON and back. The latter throws `Error` (invalid_input) that names `file`.
[[nodiscard]] nlohmann::ordered_json run_json(const BenchRun& run);
[[nodiscard]] BenchRun parse_run(const nlohmann::ordered_json& json,
                                 const std::filesystem::path& file);

}  // namespace bdpt::eval
