#include "fuzz_target.h"
#include "mutator.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

// Runs a fuzz target without libFuzzer: on all files of the folders that are named, then on mutants
// of them. NAME [-runs=N] [-max_total_time=SECONDS] [-seed=N] FILE|FOLDER... Other options of
// libFuzzer are ignored.

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr unsigned seconds_for_one = 10;
constexpr std::size_t max_bytes = 1u << 20;
constexpr const char* crash_file = "crash-input";

/// What the target works on, for the signal handler.
const Bytes* current = nullptr;

/// Keeps the input. Calls nothing that a signal handler must not call.
void on_signal(int signal)
{
    const int file = ::open(crash_file, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file >= 0 && current != nullptr) {
        static_cast<void>(!::write(file, current->data(), current->size()));
        ::close(file);
    }
    constexpr char text[] = "the input is in crash-input\n";
    static_cast<void>(!::write(STDERR_FILENO, text, sizeof text - 1));
    ::signal(signal, SIG_DFL);
    ::raise(signal);
}

Bytes read(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw std::runtime_error("cannot read " + file.string());
    }
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// An exception that leaves the target is a finding, and ends the process here.
void run(const Bytes& input) noexcept
{
    current = &input;
    ::alarm(seconds_for_one);
    static_cast<void>(LLVMFuzzerTestOneInput(input.data(), input.size()));
    ::alarm(0);
    current = nullptr;
}

std::vector<std::filesystem::path> find_files(const std::filesystem::path& place)
{
    if (!std::filesystem::is_directory(place)) {
        return {place};
    }
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(place)) {
        if (entry.is_regular_file()) {
            files.push_back(entry.path());
        }
    }
    std::sort(files.begin(), files.end());  // the order of folders is nobody's promise
    return files;
}

int replay(const std::vector<std::string>& words)
{
    std::optional<std::uint64_t> runs;
    std::uint64_t seconds = 0;
    std::uint64_t seed = 1;
    std::vector<Bytes> corpus;
    for (const std::string& word : words) {
        if (word.starts_with("-runs=")) {
            runs = std::stoull(word.substr(6));
        } else if (word.starts_with("-seed=")) {
            seed = std::stoull(word.substr(6));
        } else if (word.starts_with("-max_total_time=")) {
            seconds = std::stoull(word.substr(16));
        } else if (!word.starts_with("-")) {
            for (const std::filesystem::path& file : find_files(word)) {
                corpus.push_back(read(file));
            }
        }
    }
    if (corpus.empty()) {
        throw std::runtime_error("no files: name some, or a folder of them");
    }
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + std::chrono::seconds(seconds);
    for (const Bytes& input : corpus) {
        run(input);
    }
    std::uint64_t done = 0;
    for (; runs ? done < *runs : Clock::now() < end; ++done) {
        const Bytes& origin = corpus[done % corpus.size()];
        run(bdpt::fuzz::mutate(origin, (seed << 32) + done, max_bytes));
    }
    std::printf("%zu files and %llu mutants: nothing broke\n", corpus.size(),
                static_cast<unsigned long long>(done));
    return EXIT_SUCCESS;
}

}  // namespace

int main(int count, char** words)
{
    for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT, SIGALRM}) {
        ::signal(signal, on_signal);
    }
    try {
        return replay({words + 1, words + count});
    } catch (const std::exception& error) {
        std::fprintf(stderr, "error: %s\n", error.what());
        return 2;
    }
}
