#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::test {

enum class StderrKind : std::uint8_t { pipe, terminal };

/// How to start the bdpt command.
struct Launch {
    std::vector<std::string> arguments;
    std::map<std::string, std::string> environment{};  ///< added to ours
    StderrKind stderr_kind = StderrKind::pipe;
    std::optional<rlim_t> address_space{};  ///< [bytes]
    std::optional<rlim_t> file_size{};      ///< [bytes]; writing beyond fails as on a full disk
    std::filesystem::path folder{};         ///< the working directory; empty: ours
};

struct Outcome {
    int exit_code = -1;  ///< -1: ended by a signal
    std::string out;
    std::string err;
};

/// The bdpt command in a process of its own; killed when this object goes before it ends.
class Subprocess {
public:
    explicit Subprocess(const Launch& launch);
    ~Subprocess();
    Subprocess(const Subprocess&) = delete;
    Subprocess& operator=(const Subprocess&) = delete;

    /// Waits until the command has printed `text` on either stream. Throws when it ends without.
    void wait_for(std::string_view text);
    void send(int signal_number) const;
    /// Waits until the command ends.
    Outcome finish();

private:
    /// Reads what there is, waiting for it. False when both streams are closed.
    bool read_some();

    pid_t id_ = -1;
    int out_ = -1;
    int err_ = -1;
    Outcome outcome_;
};

/// Runs `bdpt arguments...` to its end.
Outcome run(const Launch& launch);
Outcome run(std::vector<std::string> arguments);

}  // namespace bdpt::test
