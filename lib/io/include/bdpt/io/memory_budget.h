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

/// A memory limit and its source.
struct MemoryLimit {
    std::uint64_t bytes = 0;
    std::string source;  ///< for people, such as "--max-memory"
    /// Code of the error when memory is refused: invalid_input if somebody chose the limit,
    /// out_of_memory if the machine has no more.
    ErrorCode code = ErrorCode::invalid_input;
};

/// Shared memory budget of one scene or one render: documents, buffers, images, meshes, instances,
/// volumes, environments and films. Each is charged before it is allocated; the numbers estimate
/// its whole cost, with all that is built from it. For one thread.
class BDPT_EXPORT MemoryBudget {
public:
    explicit MemoryBudget(MemoryLimit limit) : limit_(std::move(limit)) {}

    /// Charges `bytes` for `what`, which begins the message if the budget is exceeded ("the film of
    /// 16x16 pixels"). Throws `Error` (with the code of the limit) that names what, how much, and
    /// the limit with its source.
    void spend(std::string_view what, std::uint64_t bytes);
    /// Throws as `spend` does, but charges nothing: for short-lived memory.
    void check(std::string_view what, std::uint64_t bytes) const;

    [[nodiscard]] const MemoryLimit& limit() const { return limit_; }
    [[nodiscard]] std::uint64_t spent() const { return spent_; }
    [[nodiscard]] std::uint64_t left() const { return limit_.bytes - spent_; }

private:
    MemoryLimit limit_;
    std::uint64_t spent_ = 0;  // [bytes], at most the limit
};

}  // namespace bdpt::io
