#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace bdpt::io {

/// A file descriptor, closed with this object.
class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    [[nodiscard]] int number() const { return number_; }
    /// Closes its descriptor, and takes over `number`.
    void adopt(int number)
    {
        close();
        number_ = number;
    }
    void close();
    /// Releases its descriptor without closing it.
    [[nodiscard]] int release()
    {
        const int number = number_;
        number_ = -1;
        return number;
    }

private:
    int number_ = -1;
};

/// Exit status of a process.
struct ProcessEnd {
    int exit_code = -1;   ///< -1: ended by a signal, or unknown
    int signal = 0;       ///< 0: ended by itself, or unknown
    std::string message;  ///< last line on its standard error
};

/// Name of the variable by which a `ChildProcess` is told the id of this process.
constexpr const char* parent_variable = "BDPT_PARENT";

/// A program whose standard output is read by this process. It inherits no open descriptors, and of
/// the environment only where libraries are. If still running, it is killed when this object is
/// destroyed.
class ChildProcess {
public:
    /// `input` is given to the program on its standard input, as a file in memory; empty: no input.
    /// Throws `Error` if it cannot be started: out_of_memory if the system has no room for another
    /// process or for the input, else unsupported.
    ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                 std::span<const std::uint8_t> input = {});
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Reads `size` bytes, waiting for them. Returns the number of bytes read: fewer only at the
    /// end of the output.
    [[nodiscard]] std::size_t read(void* bytes, std::size_t size);

    /// Waits for its end. Further output is lost. Called once.
    [[nodiscard]] ProcessEnd wait();

private:
    pid_t id_ = -1;      // -1: there is nothing to wait for
    Descriptor output_;  // read end
    Descriptor errors_;  // a file in memory, so that nobody has to read while it is written
};

}  // namespace bdpt::io
