#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace bdpt::view {

/// Returns the self-contained page of `bdpt view`.
[[nodiscard]] std::string view_page();

// Parts of the page: files of lib/view/src/page, and those shared with the report of bdpt bench.
[[nodiscard]] std::string_view page_template();
[[nodiscard]] std::string_view page_style();
[[nodiscard]] std::string_view page_script();

/// Returns an unguessable token of 128 bits, in 32 digits. Throws `Error` (internal) if the system
/// provides none.
[[nodiscard]] std::string random_token();

/// Compares texts in constant time for texts of equal length, wherever they differ.
[[nodiscard]] bool are_equal_in_constant_time(std::string_view a, std::string_view b);

/// Reason for refusing a request.
struct Refusal {
    int status = 403;  ///< HTTP status
    std::string line;
};

/// Path, behind the token, that an environment is put to.
inline constexpr std::string_view environment_path = "environment";

/// Decodes "%20" to a space; none: a % is not followed by two digits.
[[nodiscard]] std::optional<std::string> percent_decoded(std::string_view text);

/// The parts of a request that identify its sender.
struct RequestHead {
    std::string_view method;
    std::string_view target;
    std::string_view host;
    std::optional<std::string_view> origin{};
};

/// Access control of the server.
class Access {
public:
    /// `host` is the address that the server listens on, as given by the user; `ticket` opens the
    /// page once.
    Access(std::string token, std::string ticket, std::string host);

    /// Returns the reason for refusing a request; none: it is allowed, and `parse_path` tells the
    /// resource.
    [[nodiscard]] std::optional<Refusal> refusal(const RequestHead& head) const;
    /// Tests whether a request has the ticket, which is void afterwards.
    [[nodiscard]] bool redeem(const RequestHead& head);
    /// Returns the target of the page.
    [[nodiscard]] std::string page() const { return "/" + token_ + "/"; }
    /// Returns the part of `target` behind the token, without the query.
    [[nodiscard]] static std::string_view parse_path(std::string_view target);
    /// Returns the part behind '?'.
    [[nodiscard]] static std::string_view parse_query(std::string_view target);

private:
    [[nodiscard]] bool is_ours(std::string_view host) const;
    /// Returns the reason for refusing a request whatever it asks for.
    [[nodiscard]] std::optional<Refusal> refusal_of_sender(const RequestHead& head) const;

    std::string token_;
    std::string ticket_;  // empty: void
    std::string host_;
    bool listens_everywhere_;
};

}  // namespace bdpt::view
