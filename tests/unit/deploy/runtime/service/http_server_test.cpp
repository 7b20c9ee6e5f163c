// SPDX-License-Identifier: Apache-2.0
// Addresses to listen on, and the server that does.

#include "deploy/runtime/service/listen_address.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <httplib.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <new>
#include <optional>
#include <thread>
#include <vector>

#include "deploy/runtime/service/http_server.h"

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

/// A connection that has said something.
int speak(int port, const std::string& words) {
  const int client = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  EXPECT_EQ(connect(client, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
  EXPECT_EQ(send(client, words.data(), words.size(), MSG_NOSIGNAL), static_cast<ssize_t>(words.size()));
  return client;
}

/// All that the server answers to `request`.
std::string answer_to(int port, const std::string& request) {
  const int client = speak(port, request);
  std::string answer;
  char buffer[4096];
  for (ssize_t got = 0; (got = recv(client, buffer, sizeof buffer, 0)) > 0;)
    answer.append(buffer, static_cast<std::size_t>(got));
  close(client);
  return answer;
}

TEST(HttpServer, WhatHeadersAskForIsNotOffered) {
  HttpServer server({"127.0.0.1", 0});
  const std::string body(100'000, 'x');
  server.on_get("/metrics", [&] { return HttpAnswer{200, body}; });
  server.start();
  std::string ranges = "GET /metrics HTTP/1.1\r\nRange: bytes=-";
  while (ranges.size() < 8000) ranges += ",-";
  for (const std::string& request :
       {ranges + "\r\n\r\n", std::string("GET /metrics HTTP/1.1\r\nAccept-Encoding: gzip, br\r\n\r\n"),
        std::string("GET /metrics HTTP/1.1\r\nContent-Length: 999999999\r\nExpect: 100-continue\r\n\r\n")}) {
    const std::string answer = answer_to(server.port(), request);
    EXPECT_THAT(answer, testing::StartsWith("HTTP/1.1 200")) << request.substr(0, 60);
    EXPECT_THAT(answer, testing::EndsWith("\r\n\r\n" + body)) << request.substr(0, 60);
    EXPECT_LT(answer.size(), body.size() + 500) << request.substr(0, 60);
  }
  std::string flood = "GET /metrics HTTP/1.1\r\n";
  while (flood.size() < 60'000) flood += "X: y\r\n";
  EXPECT_THAT(answer_to(server.port(), flood), testing::StartsWith("HTTP/1.1 431"));
}

TEST(HttpServer, AHandlerThatThrowsIsAnsweredAndTheNextRequestToo) {
  HttpServer server({"127.0.0.1", 0});
  server.on_get("/throws", []() -> HttpAnswer { throw std::bad_alloc(); });
  server.on_get("/good", [] { return HttpAnswer{200, "good"}; });
  server.start();
  EXPECT_THAT(answer_to(server.port(), "GET /throws HTTP/1.1\r\n\r\n"), testing::StartsWith("HTTP/1.1 500"));
  EXPECT_EQ(get(server.port(), "/good"), "good");
  EXPECT_THAT(answer_to(server.port(), "POST /good HTTP/1.1\r\n\r\n"), testing::StartsWith("HTTP/1.1 404"));
  EXPECT_THAT(answer_to(server.port(), "garbage\r\n\r\n"), testing::StartsWith("HTTP/1.1 400"));
}

TEST(HttpServer, SlowClientsDoNotKeepTheOthersWaiting) {
  HttpServer server({"127.0.0.1", 0});
  server.on_get("/health", [] { return HttpAnswer{200, "well"}; });
  const std::string large(20'000'000, 'x');
  server.on_get("/large", [&] { return HttpAnswer{200, large}; });
  server.start();
  const int deaf = speak(server.port(), "GET /large HTTP/1.1\r\n\r\n");
  std::vector<int> slow;
  std::vector<double> waits_ms;
  for (int i = 0; i < 200; ++i) {  // more than there is room for
    slow.push_back(speak(server.port(), "G"));
    const auto begin = std::chrono::steady_clock::now();
    EXPECT_EQ(get(server.port(), "/health"), "well") << i;
    waits_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
  }
  std::sort(waits_ms.begin(), waits_ms.end());
  std::printf("/health among 200 slow clients: p50 %.2f ms, p99 %.2f ms\n", waits_ms[100], waits_ms[198]);
  EXPECT_LT(waits_ms[198], 100.0);
  for (const int client : slow) close(client);
  close(deaf);
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
