#include "engine/scenery/world/sign_catalogue.hpp"

#include <cstdint>
#include <string>

#include <doctest/doctest.h>

#include "engine/scenery/world/sign_paint.hpp"

namespace septet::scenery {
namespace {

SignFace face(const std::string& country, const std::string& type, const std::string& subtype, double value,
              const std::string& name = "", const std::string& unit = "") {
  road::Signal signal;
  signal.country = country;
  signal.type = type;
  signal.subtype = subtype;
  signal.value = value;
  signal.name = name;
  signal.unit = unit;
  return sign_face(signal);
}

image::Color pixel(const SignFace& face, double x, double y) {
  const image::Image picture = paint_sign(face);
  return picture.at(static_cast<std::uint32_t>(x * picture.width), static_cast<std::uint32_t>(y * picture.height));
}

}  // namespace

TEST_CASE("signs are found in the tables of their countries") {
  CHECK(face("OpenDRIVE", "274", "55", 50) == SignFace{SignStyle::prohibition, SignSymbol::text, "50"});
  CHECK(face("OpenDRIVE", "274", "55", 0) == SignFace{SignStyle::prohibition, SignSymbol::text, "50"});
  CHECK(face("de", "206", "", 0).style == SignStyle::stop);
  CHECK(face("DE", "205", "-1", 0).style == SignStyle::yield);
  CHECK(face("", "306", "", 0).style == SignStyle::priority);
  CHECK(face("de", "301", "", 0).style == SignStyle::warning);
  CHECK(face("de", "274", "1", 30).style == SignStyle::white_board);
  CHECK(face("se", "c", "31", 5) == SignFace{SignStyle::prohibition, SignSymbol::text, "50", true});
  CHECK(face("SE", "C31", "", 70).text == "70");
  CHECK(face("se", "a", "20", 1).symbol == SignSymbol::works);
  CHECK(face("us", "R1-1", "", 0).style == SignStyle::stop);
  CHECK(face("cn", "jin", "", 70, "speed_highest_70") == SignFace{SignStyle::prohibition, SignSymbol::text, "70"});
  CHECK(face("cn", "shi", "", 50, "speed_lowest_50").style == SignStyle::mandatory);
  CHECK(face("", "", "", 0, "de_274-50") == SignFace{SignStyle::prohibition, SignSymbol::text, "50"});
}

TEST_CASE("a sign of no table is blank and not another sign") {
  CHECK(face("fr", "206", "", 0) == SignFace{});
  CHECK(face("de", "99999", "", 0) == SignFace{});
  CHECK(face("se", "z", "9", 0).style == SignStyle::blank);
  CHECK(face("de", "274", "", 1e300).text.empty());
  CHECK(face("de", "274", "", -5).text.empty());
}

TEST_CASE("faces have the colours by which they are known") {
  const image::Color stop = pixel({SignStyle::stop}, 0.5, 0.2), limit_rim = pixel({SignStyle::prohibition}, 0.5, 0.06),
                     limit = pixel({SignStyle::prohibition}, 0.5, 0.5),
                     priority = pixel({SignStyle::priority}, 0.5, 0.5),
                     mandatory = pixel({SignStyle::mandatory}, 0.5, 0.9),
                     swedish = pixel({SignStyle::warning, SignSymbol::none, "", true}, 0.5, 0.6);
  CHECK((stop.red > 150 && stop.green < 60));
  CHECK((limit_rim.red > 150 && limit_rim.green < 60));
  CHECK((limit.red > 230 && limit.blue > 230));
  CHECK((priority.red > 200 && priority.blue < 80));
  CHECK((mandatory.blue > 120 && mandatory.red < 60));
  CHECK((swedish.red > 200 && swedish.blue < 80));
}

}  // namespace septet::scenery
