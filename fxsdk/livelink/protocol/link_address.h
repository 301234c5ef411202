/// @file link_address.h
/// Addresses of live links, and the folder in which games of this user listen.
#pragma once

#include "foundation/result/status.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace fx::link {

struct Address
{
    std::string path;  ///< of the Unix socket; empty: TCP on 127.0.0.1
    uint16_t port = 0; ///< TCP port

    bool isTcp() const { return path.empty(); }
};

/// A socket in the folder.
struct Game
{
    std::string name; ///< as the game states it
    int64_t pid = 0;  ///< of the process
    Address address;
};

/// "unix:PATH" or "tcp:127.0.0.1:PORT".
std::string toString(const Address& address);

/// Reads "unix:PATH", "tcp:PORT", "tcp:127.0.0.1:PORT", a path with a slash, or the name of a game in the
/// folder (NAME or NAME-PID).
/// @return InvalidArgument, NotFound (no game has the name), Capacity (several have it)
base::Result<Address> parseAddress(const std::string& text);

/// $XDG_RUNTIME_DIR/fxsdk, or /tmp/fxsdk-UID without that variable.
std::string linkFolder();

/// Makes a folder that only this user can enter. @return Io also if others own or can enter it
base::Status makePrivateFolder(const std::string& folder);

/// Sockets of running processes in the folder, by name and process. Files whose process has ended are left
/// out.
std::vector<Game> findGames(const std::string& folder = linkFolder());

/// Whether a text may be the name of a game.
bool isGameName(std::string_view name);

} // namespace fx::link
