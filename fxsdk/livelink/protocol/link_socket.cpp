#include "fxsdk/livelink/protocol/link_socket.h"

#include <algorithm>
#include <arpa/inet.h>
#include <cerrno>
#include <cstring>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>
#include <utility>

namespace fx::link {

namespace {

constexpr int kWaiting = 4; ///< connections that may wait to be accepted

base::Status failure(const Address& address)
{
    const base::Code code = errno == ENOENT || errno == ECONNREFUSED ? base::Code::NotFound : base::Code::Io;
    return {code, toString(address) + ": " + std::strerror(errno)};
}

sockaddr_in loopback(uint16_t port)
{
    sockaddr_in name{};
    name.sin_family = AF_INET;
    name.sin_port = htons(port);
    name.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return name;
}

base::Result<sockaddr_un> fileName(const Address& address)
{
    sockaddr_un name{};
    name.sun_family = AF_UNIX;
    if (address.path.size() >= sizeof name.sun_path)
        return base::Status(base::Code::InvalidArgument,
                            address.path + ": the path of a Unix socket has at most " +
                                std::to_string(sizeof name.sun_path - 1) + " bytes");
    std::copy(address.path.begin(), address.path.end(), name.sun_path);
    return name;
}

int makeSocket(const Address& address)
{
    return socket(address.isTcp() ? AF_INET : AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
}

/// Calls bind() or connect() with the name of the address.
template <class F>
base::Status named(const Address& address, F&& call)
{
    if (address.isTcp()) {
        const sockaddr_in name = loopback(address.port);
        return call(reinterpret_cast<const sockaddr*>(&name), socklen_t(sizeof name)) == 0 ? base::Status()
                                                                                           : failure(address);
    }
    const base::Result<sockaddr_un> name = fileName(address);
    if (!name)
        return name.status();
    return call(reinterpret_cast<const sockaddr*>(&*name), socklen_t(sizeof *name)) == 0 ? base::Status()
                                                                                         : failure(address);
}

/// Whether the process at the other end belongs to this user or the superuser.
bool isOwnPeer(int descriptor)
{
    ucred peer{};
    socklen_t size = sizeof peer;
    return getsockopt(descriptor, SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 &&
           (peer.uid == geteuid() || peer.uid == 0);
}

void sendAtOnce(int descriptor)
{
    const int on = 1;
    (void)setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

} // namespace

Socket::~Socket()
{
    if (descriptor_ >= 0)
        close(descriptor_);
}

Socket::Socket(Socket&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

Socket& Socket::operator=(Socket&& other) noexcept
{
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

base::Result<Socket> Socket::listen(Address& ioAddress)
{
    Socket made(makeSocket(ioAddress));
    if (!made.isOpen())
        return failure(ioAddress);
    int bindError = 0;
    const auto bindIt = [&](const sockaddr* name, socklen_t size) {
        const int result = bind(made.descriptor_, name, size);
        bindError = errno;
        return result;
    };
    if (!ioAddress.isTcp())
        (void)fchmod(made.descriptor_, S_IRUSR | S_IWUSR); // the file gets this mode
    base::Status status = named(ioAddress, bindIt);
    if (!status && !ioAddress.isTcp() && bindError == EADDRINUSE &&
        connect(ioAddress).status().code() == base::Code::NotFound)
    { // no process accepts connections at this file
        (void)unlink(ioAddress.path.c_str());
        status = named(ioAddress, bindIt);
    }
    if (!status)
        return status;
    if (::listen(made.descriptor_, kWaiting) != 0)
        return failure(ioAddress);
    if (ioAddress.isTcp()) {
        sockaddr_in name{};
        socklen_t size = sizeof name;
        if (getsockname(made.descriptor_, reinterpret_cast<sockaddr*>(&name), &size) == 0)
            ioAddress.port = ntohs(name.sin_port);
    }
    return made;
}

base::Result<Socket> Socket::connect(const Address& address)
{
    Socket made(makeSocket(address));
    if (!made.isOpen())
        return failure(address);
    base::Status status = named(address, [&](const sockaddr* name, socklen_t size) {
        const int result = ::connect(made.descriptor_, name, size);
        return result != 0 && errno == EINPROGRESS ? 0
                                                   : result; // what is refused ends with the first receive()
    });
    if (!status)
        return status;
    if (address.isTcp())
        sendAtOnce(made.descriptor_);
    return made;
}

std::optional<Socket> Socket::accept(bool isTcp)
{
    Socket made(accept4(descriptor_, nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!made.isOpen() || (!isTcp && !isOwnPeer(made.descriptor_)))
        return std::nullopt;
    if (isTcp)
        sendAtOnce(made.descriptor_);
    return made;
}

base::Result<size_t> Socket::receive(char* out, size_t size)
{
    const ssize_t count = recv(descriptor_, out, size, 0);
    if (count > 0)
        return size_t(count);
    if (count == 0)
        return base::Status(base::Code::Io, "the other side has closed the connection");
    if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR || errno == ENOTCONN)
        return size_t(0);
    return base::Status(base::Code::Io, std::strerror(errno));
}

base::Result<size_t> Socket::send(std::string_view bytes)
{
    const ssize_t count = ::send(descriptor_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count >= 0)
        return size_t(count);
    if (errno == EAGAIN || errno == EWOULDBLOCK || errno == EINTR || errno == ENOTCONN)
        return size_t(0);
    return base::Status(base::Code::Io, std::strerror(errno));
}

void Socket::wait(double seconds, bool writes) const
{
    pollfd what{descriptor_, short(writes ? POLLIN | POLLOUT : POLLIN), 0};
    (void)poll(&what, 1, int(std::clamp(seconds, 0.0, 3600.0) * 1000.0 + 0.5));
}

} // namespace fx::link
