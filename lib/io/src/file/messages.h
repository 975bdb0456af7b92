#pragma once

#include <bdpt/error.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <new>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::io {

/// What a warning says about the picture.
enum class WarningKind : std::uint8_t {
    harmless,  ///< the file is odd, but the picture is what it means
    loss,   ///< data of the file is missing or damaged, or not supported, and the picture lacks it
    draft,  ///< the picture depends on a specification that may change
};

/// Collects warnings. Those of one text are counted and become one line with the first place.
class Warnings {
public:
    /// Adds a harmless warning. `text` says what is odd and what is done about it; `place` where,
    /// and which value.
    void add(const std::string& text, const std::string& place)
    {
        add(WarningKind::harmless, text, place);
    }
    void add(WarningKind kind, const std::string& text, const std::string& place);

    /// Returns one line per text, in the order of their first appearance, without drafts.
    [[nodiscard]] std::vector<std::string> lines() const;

    /// Returns such lines about drafts.
    [[nodiscard]] std::vector<std::string> drafts() const;

    /// Throws `Error` (unsupported) with the first line that is not harmless, and the number of
    /// others.
    void refuse_harm() const;

private:
    friend class Silence;
    struct Entry {
        WarningKind kind;
        std::string text;
        std::string first_place;
        std::size_t count = 0;
    };
    [[nodiscard]] static std::string line(const Entry& entry);

    std::vector<Entry> entries_;
    std::map<std::string, std::size_t> index_;
    bool silent_ = false;
};

/// Discards warnings during its lifetime, for work that is repeated and warns the first or last
/// time.
class Silence {
public:
    explicit Silence(Warnings& warnings) : warnings_(warnings), before_(warnings.silent_)
    {
        warnings.silent_ = true;
    }
    ~Silence() { warnings_.silent_ = before_; }
    Silence(const Silence&) = delete;
    Silence& operator=(const Silence&) = delete;

private:
    Warnings& warnings_;
    bool before_;
};

/// Returns, for the message about a failed allocation, the peak memory of this process, and its
/// limit (ulimit -v) or else the memory of the machine.
[[nodiscard]] std::string memory_figures();

/// Returns what `work()` returns. Exceptions of libraries become an `Error` with this code, whose
/// message is one line that begins with `prefix`; an `Error` and std::bad_alloc are passed on.
template <typename Work>
auto with_library_errors(ErrorCode code, const std::string& prefix, const Work& work)
{
    try {
        return work();
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& error) {
        std::string what = error.what();
        std::replace(what.begin(), what.end(), '\n', ' ');
        throw Error(code, prefix + what);
    }
}

/// Returns what `read()` returns. All exceptions become an `Error` whose message begins with the
/// name of the file: an `Error` keeps its code, std::bad_alloc is out_of_memory with figures, all
/// others are internal.
template <typename Read>
[[nodiscard]] auto with_named_errors(const std::filesystem::path& file, const Read& read)
{
    const std::string prefix = file.string() + ": ";
    try {
        return read();
    } catch (const Error& error) {
        throw Error(error.code(), prefix + error.what());
    } catch (const std::bad_alloc&) {
        throw Error(ErrorCode::out_of_memory, prefix + "not enough memory: " + memory_figures());
    } catch (const std::exception& error) {
        throw Error(ErrorCode::internal, prefix + error.what());
    }
}

}  // namespace bdpt::io
