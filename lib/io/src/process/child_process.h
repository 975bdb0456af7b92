#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace bdpt::io {

/// A descriptor of the system, closed with this object.
class Descriptor {
public:
    explicit Descriptor(int number) : number_(number) {}
    ~Descriptor() { close(); }
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    [[nodiscard]] int number() const { return number_; }
    /// Closes what it has, and takes over `number`.
    void adopt(int number)
    {
        close();
        number_ = number;
    }
    void close();
    /// Gives away what it has, without closing it.
    [[nodiscard]] int release()
    {
        const int number = number_;
        number_ = -1;
        return number;
    }

private:
    int number_ = -1;
};

/// How a process ended.
struct ProcessEnd {
    int exit_code = -1;   ///< -1: by a signal, or nobody knows
    int signal = 0;       ///< 0: by itself, or nobody knows
    std::string message;  ///< the last line on its standard error
};

/// A program that writes what it has to say to its standard output, which is read here. It sees
/// nothing that this process has open. What is still running when this object goes is killed.
class ChildProcess {
public:
    /// `input` is a file in memory on its standard input; without any the input is empty. Throws
    /// `Error` when it cannot be started: out_of_memory where the system has no room for another
    /// process or for the input, else unsupported.
    ChildProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                 std::span<const std::uint8_t> input = {});
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Reads `size` bytes, and waits for them. How many there were: less than that only where the
    /// output ends.
    [[nodiscard]] std::size_t read(void* bytes, std::size_t size);

    /// Waits for its end. What it writes from here on gets lost. Called once.
    [[nodiscard]] ProcessEnd wait();

private:
    pid_t id_ = -1;      // -1: there is nothing to wait for
    Descriptor output_;  // read from
    Descriptor errors_;  // a file in memory, so that nobody has to read while it is written
};

}  // namespace bdpt::io
