#pragma once

#include <bdpt/export.h>

#include <stdexcept>
#include <string>

namespace bdpt {

/// Why a call failed. The values are the exit codes of the `bdpt` command, so they never change.
enum class ErrorCode {
    internal = 1,       ///< a defect of the program or of a library below it
    usage = 2,          ///< options that make no sense
    not_found = 3,      ///< an input that is missing or cannot be read
    invalid_input = 4,  ///< an input that breaks its format or a limit
    unsupported = 5,    ///< an input that requires a feature we do not have
    output = 6,         ///< a result that cannot be written
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
