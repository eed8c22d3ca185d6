#include "shared/transport/network.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <memory>

#include "shared/transport/participant.hpp"

namespace cosight::transport {

namespace {

// What a new UDP socket gets of `bytes`; the kernel answers with twice what it grants.
int granted(int option, int bytes) {
  const int socket_fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (socket_fd < 0) return 0;
  setsockopt(socket_fd, SOL_SOCKET, option, &bytes, sizeof bytes);
  int doubled = 0;
  socklen_t length = sizeof doubled;
  getsockopt(socket_fd, SOL_SOCKET, option, &doubled, &length);
  close(socket_fd);
  return doubled / 2;
}

std::string address_text(const sockaddr* address) {
  std::array<char, INET_ADDRSTRLEN> text{};
  const auto* ipv4 = reinterpret_cast<const sockaddr_in*>(address);
  inet_ntop(AF_INET, &ipv4->sin_addr, text.data(), text.size());
  return text.data();
}

}  // namespace

std::string ipv4_of_interface(const std::string& interface) {
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) throw TransportError("the network interfaces can't be listed");
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> all(first, &freeifaddrs);
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    std::string address = address_text(entry->ifa_addr);
    if (interface == entry->ifa_name || interface == address) return address;
  }
  throw TransportError("network interface \"" + interface +
                       "\" does not exist or has no IPv4 address yet: start when `ip addr` shows one");
}

std::string refused_socket_buffer(int bytes) {
  const int receive = granted(SO_RCVBUF, bytes);
  const int send = granted(SO_SNDBUF, bytes);
  if (receive >= bytes && send >= bytes) return {};
  return "the kernel grants socket buffers of " + std::to_string(receive) + " B (receive) and " +
         std::to_string(send) + " B (send) instead of " + std::to_string(bytes) +
         ": large frames will be slow or lost. sudo sysctl -w net.core.rmem_max=" + std::to_string(bytes) +
         " net.core.wmem_max=" + std::to_string(bytes);
}

}  // namespace cosight::transport
