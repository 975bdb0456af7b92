#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace bdpt::io {

/// The numbers of a text one after the other, apart by blanks, commas and ends of lines [LM-63-02,
/// "delimiter"].
class IesNumbers {
public:
    /// `first_line`: number of the text's first line in its file.
    IesNumbers(std::string_view text, std::size_t first_line) : rest_(text), line_(first_line) {}

    /// The next number, which is finite. `what` it should be is for the message of the `Error`
    /// (invalid_input) that is thrown when there is none.
    [[nodiscard]] double next(std::string_view what);
    /// The next number, which must be an integer in [least, most].
    [[nodiscard]] long next_integer(std::string_view what, long least, long most);
    /// Is there anything left?
    [[nodiscard]] bool at_end();

    /// Throws `Error` (invalid_input) that names the line of the last number.
    [[noreturn]] void fail(const std::string& what) const;

private:
    void skip_delimiters();

    std::string_view rest_;
    std::size_t line_;
};

}  // namespace bdpt::io
