#pragma once

/// @file
/// Limits the memory that a scene and its render take together.
///
/// @code{.cpp}
/// const auto memory = std::make_shared<bdpt::io::MemoryBudget>(
///     bdpt::io::MemoryLimit{.bytes = std::uint64_t{4} << 30, .source = "the job's limit"});
/// bdpt::io::GltfOptions options;
/// options.memory = memory;
/// const bdpt::Scene scene(bdpt::io::load_gltf("city.glb", options).scene);
/// std::cout << memory->left() << " bytes are left for the film\n";
/// @endcode

#include <bdpt/error.h>
#include <bdpt/export.h>

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

namespace bdpt::io {

/// How much memory may be taken, and where that number comes from.
struct MemoryLimit {
    std::uint64_t bytes = 0;
    std::string source;  ///< for people, such as "--max-memory"
    /// Of what is refused: invalid_input where somebody chose the limit, out_of_memory where the
    /// machine has no more.
    ErrorCode code = ErrorCode::invalid_input;
};

/// What all that belongs to one scene or one render may take together: documents, buffers, images,
/// meshes, instances, volumes, environments and films. Each asks before it takes; the numbers are
/// estimates of what it costs until the end, with all that is built from it. For one thread.
class BDPT_EXPORT MemoryBudget {
public:
    explicit MemoryBudget(MemoryLimit limit) : limit_(std::move(limit)) {}

    /// Takes `bytes` for `what`, which begins the message if there is no more ("the film of 16x16
    /// pixels"). Throws `Error` (the code of the limit) that names what, how much, and the limit
    /// with its source.
    void spend(std::string_view what, std::uint64_t bytes);
    /// Throws as `spend` does, but takes nothing: for what is gone soon.
    void check(std::string_view what, std::uint64_t bytes) const;

    [[nodiscard]] const MemoryLimit& limit() const { return limit_; }
    [[nodiscard]] std::uint64_t spent() const { return spent_; }
    [[nodiscard]] std::uint64_t left() const { return limit_.bytes - spent_; }

private:
    MemoryLimit limit_;
    std::uint64_t spent_ = 0;  // [bytes], at most the limit
};

}  // namespace bdpt::io
