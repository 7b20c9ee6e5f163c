// Addresses to listen on, and the server that does.

#include "deploy/service/listen_address.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <optional>
#include <thread>

#include "deploy/service/http_server.h"

namespace {

using namespace ehm::service;

TEST(ListenAddress, ReadsNamesAndBothFamilies) {
  const auto v4 = parse_listen_address("127.0.0.1:9477");
  EXPECT_EQ(v4.host, "127.0.0.1");
  EXPECT_EQ(v4.port, 9477);
  EXPECT_TRUE(v4.loopback());
  const auto v6 = parse_listen_address("[::1]:0");
  EXPECT_EQ(v6.host, "::1");
  EXPECT_EQ(v6.port, 0);
  EXPECT_TRUE(v6.loopback());
  EXPECT_TRUE(parse_listen_address("localhost:65535").loopback());
  EXPECT_FALSE(parse_listen_address("0.0.0.0:80").loopback());
}

TEST(ListenAddress, RefusesWhatIsNone) {
  for (const char* text :
       {"", "9477", ":9477", "host:", "host:x", "host:1x", "host:65536", "host:-1", "::1:9477", "[]:1"})
    EXPECT_THROW(parse_listen_address(text), std::invalid_argument) << text;
}

TEST(HttpServer, SaysWhyAnAddressCannotBeHad) {
  const HttpServer first({"127.0.0.1", 0});
  EXPECT_GT(first.port(), 0);
  try {
    const HttpServer second({"127.0.0.1", first.port()});
    FAIL() << "two servers on one port";
  } catch (const std::runtime_error& e) {
    EXPECT_THAT(e.what(), testing::HasSubstr("Address already in use"));
  }
  EXPECT_THROW(HttpServer({"256.0.0.1", 0}), std::runtime_error);
}

/// GETs `path`; the body, or nothing where no whole answer came.
std::optional<std::string> get(int port, const std::string& path) {
  httplib::Client client("127.0.0.1", port);
  const auto result = client.Get(path);
  return result ? std::optional(result->body) : std::nullopt;
}

TEST(HttpServer, AnswersWhatIsLargerThanTheSocketsBuffers) {
  HttpServer server({"127.0.0.1", 0});
  const std::string large(20'000'000, 'x');
  server.on_get("/large", [&] { return HttpAnswer{200, large}; });
  server.start();
  EXPECT_EQ(get(server.port(), "/large"), large);
}

TEST(HttpServer, StopsWhileAClientAsksOrDoesNotListen) {
  auto server = std::make_unique<HttpServer>(ListenAddress{"127.0.0.1", 0});
  std::atomic<int> answers{0};
  server->on_get("/large", [&] {
    ++answers;
    return HttpAnswer{200, std::string(20'000'000, 'x')};
  });
  server->start();
  const int deaf = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(server->port()));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(connect(deaf, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
  const std::string request = "GET /large HTTP/1.1\r\n\r\n";
  ASSERT_EQ(send(deaf, request.data(), request.size(), 0), static_cast<ssize_t>(request.size()));
  while (answers == 0) std::this_thread::yield();
  const auto begin = std::chrono::steady_clock::now();
  server.reset();  // without the flag it would write on for two seconds
  EXPECT_LT(std::chrono::steady_clock::now() - begin, HttpServer::answer_limit - std::chrono::milliseconds(500));
  close(deaf);
}

}  // namespace
