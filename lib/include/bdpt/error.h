#pragma once

/// @file
/// Tells why a call failed.
///
/// @code{.cpp}
/// try {
///     const bdpt::Scene scene(bdpt::io::load_gltf("model.glb").scene);
/// } catch (const bdpt::Error& error) {
///     std::cerr << error.what() << '\n';
///     std::exit(static_cast<int>(error.code()));
/// }
/// @endcode

#include <bdpt/export.h>

#include <stdexcept>
#include <string>

namespace bdpt {

/// The reason for a failure. The values are the exit codes of the `bdpt` command, so they never
/// change.
enum class ErrorCode {
    internal = 1,       ///< defect of the program or of a library it uses
    usage = 2,          ///< invalid or contradictory options
    not_found = 3,      ///< input that is missing or cannot be read
    invalid_input = 4,  ///< input that violates its format or a limit
    unsupported = 5,    ///< input that requires an unsupported feature
    output = 6,         ///< output that cannot be written
    out_of_memory = 7,
};

/// Thrown for bad input or a failing dependency. Never thrown while rays are traced. The message is
/// one line that names the item and the value.
class BDPT_EXPORT Error : public std::runtime_error {
public:
    Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}

    [[nodiscard]] ErrorCode code() const noexcept { return code_; }

private:
    ErrorCode code_;
};

}  // namespace bdpt
