// Addresses to listen on, and the server that does.

#include "deploy/service/listen_address.h"

#include <gmock/gmock.h>

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

}  // namespace
