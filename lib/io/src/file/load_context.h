#pragma once

#include <bdpt/io/gltf.h>
#include <bdpt/io/read_limits.h>
#include <bdpt/types.h>

#include <cstdint>
#include <memory>
#include <string>

#include "file/messages.h"
#include "file/read_file.h"

namespace bdpt::io {

// Memory [bytes] of parts of a scene, from reading until the last image, with all that is built
// from them, beyond their descriptions. Measured by benchmarks/scale_table.py; checked by
// tests/apps/files/memory_test.py.

/// A document as JSON values and structs of tinygltf, per byte of its text.
constexpr std::uint64_t parsed_growth = 5;

/// Copies of corners and indices, data for hits, and Embree's BVH.
constexpr std::uint64_t traced_triangle = 150;

/// Placement of a mesh, and Embree's part of it.
constexpr std::uint64_t placed_instance = 500;

/// A pixel of an environment of floats: in the description, in the light (where halves take less
/// than this), and in its sampling table.
constexpr std::uint64_t environment_pixel = sizeof(Rgb) + 2 * sizeof(float) + sizeof(std::uint16_t);

/// A pixel of an environment of halves, which description and light share, and in its table.
constexpr std::uint64_t compact_environment_pixel =
    3 * sizeof(std::uint16_t) + sizeof(std::uint16_t);

/// Budget of the decoded vertices, triangles, key frames, light profiles and instances of one file,
/// and of all its memory. An accessor counts each time it is used: a few bytes of JSON may name one
/// of gigabytes a thousand times.
class DataBudget {
public:
    /// `memory` is the budget for everything in the file; null: a budget of
    /// `ReadLimits::memory_bytes`.
    explicit DataBudget(const ReadLimits& limits, std::shared_ptr<MemoryBudget> memory = nullptr);

    /// Charges `count` elements of `size` bytes. `place` is the JSON pointer to their user. Throws
    /// `Error` (invalid_input) that names place, need and limit if the budget is exceeded.
    void spend(const std::string& place, std::uint64_t count, std::uint64_t size);

    /// Returns the budget for everything other than vertices, key frames, light profiles and
    /// instances.
    [[nodiscard]] MemoryBudget& memory() { return *memory_; }
    [[nodiscard]] const MemoryBudget& memory() const { return *memory_; }

private:
    std::uint64_t limit_ = 0;  // [bytes]
    std::uint64_t spent_ = 0;  // [bytes]
    std::shared_ptr<MemoryBudget> memory_;
};

class Ktx2Decoder;  // image/ktx2_decoder.h

/// State shared by all steps of loading one file.
struct LoadContext {
    SceneFolders folders{};
    ReadLimits limits{};
    std::shared_ptr<MemoryBudget> memory{};  ///< budget of the caller, if any
    DataBudget budget{limits, memory};
    Warnings warnings{};
    ImageCache* images = nullptr;  ///< shared with other loads, if any
    Ktx2Decoder* ktx2 = nullptr;   ///< null: KTX2 images are not decoded
    bool ignore_required = false;  ///< `GltfOptions::ignore_required`

    /// Adds a warning about something harmless.
    void warn(const std::string& text, const std::string& place) { warnings.add(text, place); }
    void warn(WarningKind kind, const std::string& text, const std::string& place)
    {
        warnings.add(kind, text, place);
    }
};

}  // namespace bdpt::io
