#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace bdpt::app {

/// What stands for the value of an option, like "N" or "mip|bilinear"; the parser adds the words
/// that it knows, ":{mip,bilinear}". Empty for flags.
[[nodiscard]] std::string value_of(const CLI::Option& option);

/// Prints options as "--name VALUE   what it does" in at most 100 columns.
class HelpFormatter : public CLI::Formatter {
public:
    HelpFormatter();
    std::string make_option_opts(const CLI::Option* option) const override;
    std::string make_option_desc(const CLI::Option* option) const override;
};

}  // namespace bdpt::app
