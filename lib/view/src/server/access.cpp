#include "server/server.h"

#include <bdpt/error.h>
#include <sys/random.h>

#include <array>
#include <charconv>
#include <cstddef>
#include <system_error>
#include <utility>

#include "options/value_types.h"

namespace bdpt::view {
namespace {

constexpr std::size_t token_bytes = 16;

/// Returns "localhost" for "localhost:8080", "[::1]" for "[::1]:8080"; empty: the port is no
/// number.
std::string_view without_port(std::string_view host)
{
    const std::size_t bracket = host.rfind(']');
    const std::size_t colon = host.find(':', bracket == std::string_view::npos ? 0 : bracket);
    const std::string_view port =
        colon == std::string_view::npos ? std::string_view() : host.substr(colon + 1);
    const bool is_number = port.find_first_not_of("0123456789") == std::string_view::npos;
    return is_number ? host.substr(0, colon) : std::string_view();
}

/// Tests for a numeric address, which no name server can redirect to another machine.
bool is_numeric(std::string_view host)
{
    constexpr std::string_view of_v4 = "0123456789.";
    return !host.empty() &&
           (host.front() == '[' || host.find_first_not_of(of_v4) == std::string_view::npos);
}

}  // namespace

std::string random_token()
{
    std::array<unsigned char, token_bytes> bytes{};
    if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
        throw Error(ErrorCode::internal, "the system cannot provide random numbers");
    }
    constexpr std::string_view digits = "0123456789abcdef";
    std::string token;
    for (const unsigned char byte : bytes) {
        token += digits[byte >> 4U];
        token += digits[byte & 15U];
    }
    return token;
}

bool are_equal_in_constant_time(std::string_view a, std::string_view b)
{
    if (a.size() != b.size()) {
        return false;
    }
    unsigned different = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        different |= static_cast<unsigned>(static_cast<unsigned char>(a[i]) ^
                                           static_cast<unsigned char>(b[i]));
    }
    return different == 0;
}

std::optional<std::string> percent_decoded(std::string_view text)
{
    constexpr std::size_t escape = 3;
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        unsigned code = 0;
        const std::string_view digits = text.substr(i, escape).substr(1);
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
        if (error != std::errc() || digits.size() + 1 != escape ||
            end != digits.data() + digits.size()) {
            return std::nullopt;
        }
        decoded += static_cast<char>(code);
        i += escape - 1;
    }
    return decoded;
}

Access::Access(std::string token, std::string ticket, std::string host)
    : token_(std::move(token)),
      ticket_(std::move(ticket)),
      host_(job::lower_case(host)),
      listens_everywhere_(host_ == "0.0.0.0" || host_ == "::")
{}

bool Access::is_ours(std::string_view host) const
{
    // Ports differ behind tunnels.
    const std::string name = job::lower_case(without_port(host));
    return !name.empty() &&
           (name == "localhost" || name == "127.0.0.1" || name == "[::1]" || name == host_ ||
            name == "[" + host_ + "]" || (listens_everywhere_ && is_numeric(name)));
}

std::optional<Refusal> Access::refusal_of_sender(const RequestHead& head) const
{
    // DNS rebinding: a foreign page's own name points to this machine.
    if (!is_ours(head.host)) {
        return Refusal{403, "this server is not known by that name"};
    }
    if (head.origin && job::lower_case(*head.origin) != "http://" + job::lower_case(head.host)) {
        return Refusal{403, "pages of others may not ask this server"};
    }
    const bool gives_file = head.method == "PUT" && parse_path(head.target) == environment_path;
    if (head.method != "GET" && !gives_file) {
        return Refusal{405, "only GET is supported"};
    }
    if (gives_file && !head.origin) {  // browsers always name it
        return Refusal{403, "only the page may give a file"};
    }
    return std::nullopt;
}

bool Access::redeem(const RequestHead& head)
{
    const bool has_ticket = !ticket_.empty() && !refusal_of_sender(head) &&
                            are_equal_in_constant_time(head.target, "/" + ticket_);
    if (has_ticket) {
        ticket_.clear();
    }
    return has_ticket;
}

std::optional<Refusal> Access::refusal(const RequestHead& head) const
{
    if (auto refusal = refusal_of_sender(head)) {
        return refusal;
    }
    const std::string_view target = head.target;
    const std::size_t end = target.find('/', 1);
    const bool has_token = target.starts_with('/') && end != std::string_view::npos &&
                           are_equal_in_constant_time(target.substr(1, end - 1), token_);
    if (!has_token) {
        return Refusal{403, "wrong address: bdpt view has printed the right one"};
    }
    return std::nullopt;
}

std::string_view Access::parse_path(std::string_view target)
{
    const std::string_view path = target.substr(0, target.find('?'));
    const std::size_t slash = path.find('/', 1);
    return slash == std::string_view::npos ? std::string_view() : path.substr(slash + 1);
}

std::string_view Access::parse_query(std::string_view target)
{
    const std::size_t mark = target.find('?');
    return mark == std::string_view::npos ? std::string_view() : target.substr(mark + 1);
}

}  // namespace bdpt::view
