#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace bdpt::job {

/// Environment variable by which the process of a model knows the one that started it.
inline constexpr const char* dataset_parent = "BDPT_DATASET_PARENT";

/// How a process ended.
struct ModelEnd {
    int exit_code = 0;    ///< a signal's is 128 and its number
    std::string message;  ///< its last error; empty: none
    bool timed_out = false;
};

/// This program in a process of its own, which renders one model. Its output is read without
/// waiting, so that several run side by side.
class ModelProcess {
public:
    /// Starts `bdpt dataset` with these arguments. Throws `Error` (out_of_memory) if that fails.
    explicit ModelProcess(const std::vector<std::string>& arguments);
    /// Kills the process if it still runs.
    ~ModelProcess();
    ModelProcess(ModelProcess&& other) noexcept;
    ModelProcess& operator=(ModelProcess&&) = delete;

    /// Returns the lines that it wrote since the last call.
    [[nodiscard]] std::vector<std::string> new_lines();
    /// Returns how it ended; none: it still runs. It is killed if it runs longer than `limit` [s].
    [[nodiscard]] std::optional<ModelEnd> end(const std::optional<double>& limit);
    /// Asks it to stop.
    void stop() const;
    /// Returns descriptors that become readable when there is something new.
    [[nodiscard]] std::vector<int> descriptors() const;
    [[nodiscard]] double seconds() const;

private:
    pid_t id_ = -1;
    int output_ = -1;
    int errors_ = -1;
    std::string line_;     // begun, not ended
    std::string message_;  // all that it wrote to its standard error
    bool killed_ = false;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Waits until one of `descriptors` is readable, or for a short time.
void wait_for_any(const std::vector<int>& descriptors);

/// Lets the kernel end this process when that of `dataset_parent` ends. Returns false if there is
/// none.
bool end_with_dataset();

}  // namespace bdpt::job
