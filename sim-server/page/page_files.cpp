#include "sim-server/page/page_files.hpp"

#include <string_view>

namespace septet::page {
namespace {

constexpr std::string_view index_html =
#include "sim-server/page/web/index.html.inc"
    ;
constexpr std::string_view page_css =
#include "sim-server/page/web/page.css.inc"
    ;
constexpr std::string_view language_js =
#include "sim-server/page/web/language.js.inc"
    ;
constexpr std::string_view language_en_js =
#include "sim-server/page/web/language_en.js.inc"
    ;
constexpr std::string_view language_de_js =
#include "sim-server/page/web/language_de.js.inc"
    ;
constexpr std::string_view language_sv_js =
#include "sim-server/page/web/language_sv.js.inc"
    ;
constexpr std::string_view socket_js =
#include "sim-server/page/web/socket.js.inc"
    ;
constexpr std::string_view conditions_js =
#include "sim-server/page/web/conditions.js.inc"
    ;
constexpr std::string_view live_js =
#include "sim-server/page/web/live.js.inc"
    ;
constexpr std::string_view screens_js =
#include "sim-server/page/web/screens.js.inc"
    ;
constexpr std::string_view events_js =
#include "sim-server/page/web/events.js.inc"
    ;
constexpr std::string_view lesson_js =
#include "sim-server/page/web/lesson.js.inc"
    ;
constexpr std::string_view car_js =
#include "sim-server/page/web/car.js.inc"
    ;
constexpr std::string_view map_js =
#include "sim-server/page/web/map.js.inc"
    ;
constexpr std::string_view sickness_js =
#include "sim-server/page/web/sickness.js.inc"
    ;
constexpr std::string_view things_js =
#include "sim-server/page/web/things.js.inc"
    ;
constexpr std::string_view placing_js =
#include "sim-server/page/web/placing.js.inc"
    ;
constexpr std::string_view placing_map_js =
#include "sim-server/page/web/placing_map.js.inc"
    ;
constexpr std::string_view operator_js =
#include "sim-server/page/web/operator.js.inc"
    ;
constexpr std::string_view start_js =
#include "sim-server/page/web/start.js.inc"
    ;
constexpr std::string_view past_js =
#include "sim-server/page/web/past.js.inc"
    ;
constexpr std::string_view record_js =
#include "sim-server/page/web/record.js.inc"
    ;
constexpr std::string_view questionnaire_js =
#include "sim-server/page/web/questionnaire.js.inc"
    ;
constexpr std::string_view page_js =
#include "sim-server/page/web/page.js.inc"
    ;

}  // namespace

std::vector<Resource> page_files() {
  constexpr const char* script = "text/javascript; charset=utf-8";
  return {{"/", "text/html; charset=utf-8", index_html},
          {"/page.css", "text/css; charset=utf-8", page_css},
          {"/language.js", script, language_js},
          {"/language_en.js", script, language_en_js},
          {"/language_de.js", script, language_de_js},
          {"/language_sv.js", script, language_sv_js},
          {"/socket.js", script, socket_js},
          {"/conditions.js", script, conditions_js},
          {"/live.js", script, live_js},
          {"/screens.js", script, screens_js},
          {"/events.js", script, events_js},
          {"/lesson.js", script, lesson_js},
          {"/car.js", script, car_js},
          {"/map.js", script, map_js},
          {"/sickness.js", script, sickness_js},
          {"/things.js", script, things_js},
          {"/placing.js", script, placing_js},
          {"/placing_map.js", script, placing_map_js},
          {"/operator.js", script, operator_js},
          {"/start.js", script, start_js},
          {"/past.js", script, past_js},
          {"/record.js", script, record_js},
          {"/questionnaire.js", script, questionnaire_js},
          {"/page.js", script, page_js}};
}

}  // namespace septet::page
