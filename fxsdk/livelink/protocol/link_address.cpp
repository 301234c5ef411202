#include "fxsdk/livelink/protocol/link_address.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <signal.h>
#include <sys/stat.h>
#include <tuple>
#include <unistd.h>

namespace fx::link {

namespace {

constexpr std::string_view kSuffix = ".sock";
constexpr std::string_view kLoopback = "127.0.0.1:";
constexpr size_t kLongestName = 64;

template <class T>
std::optional<T> numberOf(std::string_view text, T least, T most)
{
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || value < least || value > most)
        return std::nullopt;
    return value;
}

bool isRunning(int64_t pid)
{
    return kill(pid_t(pid), 0) == 0 || errno == EPERM;
}

base::Result<Address> addressOfGame(const std::string& name)
{
    const std::vector<Game> games = findGames();
    std::string known;
    Address found;
    int count = 0;
    for (const Game& game : games) {
        const std::string full = game.name + "-" + std::to_string(game.pid);
        known += (known.empty() ? "" : ", ") + full;
        if (name != game.name && name != full)
            continue;
        found = game.address;
        ++count;
    }
    if (count == 1)
        return found;
    if (count > 1)
        return base::Status(base::Code::Capacity,
                            "several games have the name \"" + name + "\"; add the process: " + known);
    return base::Status(base::Code::NotFound,
                        "no running game has the name \"" + name + "\" in " + linkFolder() +
                            (known.empty() ? "; none is running there" : "; there are: " + known));
}

} // namespace

std::string toString(const Address& address)
{
    return address.isTcp() ? "tcp:" + std::string(kLoopback) + std::to_string(address.port)
                           : "unix:" + address.path;
}

base::Result<Address> parseAddress(const std::string& text)
{
    std::string_view rest(text);
    if (rest.starts_with("tcp:")) {
        rest.remove_prefix(4);
        if (rest.starts_with(kLoopback))
            rest.remove_prefix(kLoopback.size());
        const auto port = numberOf<uint32_t>(rest, 1, 65535);
        if (!port)
            return base::Status(base::Code::InvalidArgument,
                                "\"" + text +
                                    "\" is no address; write tcp:127.0.0.1:PORT with a port from 1 to 65535");
        return Address{"", uint16_t(*port)};
    }
    const bool isUnix = rest.starts_with("unix:");
    if (isUnix)
        rest.remove_prefix(5);
    if (rest.empty())
        return base::Status(base::Code::InvalidArgument, "the address is empty; `fx link list` lists games");
    if (isUnix || rest.find('/') != std::string_view::npos)
        return Address{std::string(rest), 0};
    return addressOfGame(text);
}

std::string linkFolder()
{
    const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
    if (runtime && runtime[0] == '/')
        return std::string(runtime) + "/fxsdk";
    return "/tmp/fxsdk-" + std::to_string(geteuid());
}

base::Status makePrivateFolder(const std::string& folder)
{
    if (mkdir(folder.c_str(), S_IRWXU) != 0 && errno != EEXIST)
        return {base::Code::Io, folder + ": " + std::strerror(errno)};
    struct stat facts
    {};
    if (lstat(folder.c_str(), &facts) != 0)
        return {base::Code::Io, folder + ": " + std::strerror(errno)};
    if (!S_ISDIR(facts.st_mode))
        return {base::Code::Io, folder + " is no folder; remove it"};
    if (facts.st_uid != geteuid() || (facts.st_mode & (S_IRWXG | S_IRWXO)) != 0)
        return {base::Code::Io,
                folder + ": others own or can enter this folder; give it to this user with mode 0700"};
    return {};
}

std::vector<Game> findGames(const std::string& folder)
{
    std::vector<Game> games;
    std::error_code error;
    for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
        const std::string file = entry.path().filename().string();
        if (!file.ends_with(kSuffix) || !entry.is_socket(error))
            continue;
        const std::string stem = file.substr(0, file.size() - kSuffix.size());
        const size_t dash = stem.rfind('-');
        if (dash == std::string::npos || !isGameName(stem.substr(0, dash)))
            continue;
        const auto pid = numberOf<int64_t>(std::string_view(stem).substr(dash + 1), 1, INT32_MAX);
        if (pid && isRunning(*pid))
            games.push_back({stem.substr(0, dash), *pid, {entry.path().string(), 0}});
    }
    std::sort(games.begin(), games.end(),
              [](const Game& a, const Game& b) { return std::tie(a.name, a.pid) < std::tie(b.name, b.pid); });
    return games;
}

bool isGameName(std::string_view name)
{
    const auto isAllowed = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' ||
               c == '_' || c == '.';
    };
    return !name.empty() && name.size() <= kLongestName && name.front() != '.' &&
           std::all_of(name.begin(), name.end(), isAllowed);
}

} // namespace fx::link
