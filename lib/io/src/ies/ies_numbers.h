#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace bdpt::io {

/// Reader of the numbers in a text, separated by blanks, commas and ends of lines [LM-63-02,
/// "delimiter"].
class IesNumbers {
public:
    /// `first_line`: number of the text's first line in its file.
    IesNumbers(std::string_view text, std::size_t first_line) : rest_(text), line_(first_line) {}

    /// Returns the next number, which is finite. Throws `Error` (invalid_input) that names the
    /// expected `what` if there is none.
    [[nodiscard]] double next(std::string_view what);
    /// Returns the next number, which must be an integer in [least, most].
    [[nodiscard]] long next_integer(std::string_view what, long least, long most);
    /// Tests whether nothing is left.
    [[nodiscard]] bool at_end();

    /// Throws `Error` (invalid_input) that names the line of the last number.
    [[noreturn]] void fail(const std::string& what) const;

private:
    void skip_delimiters();

    std::string_view rest_;
    std::size_t line_;
};

}  // namespace bdpt::io
