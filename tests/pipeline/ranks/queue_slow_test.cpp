#include <csignal>
#include <string>
#include <vector>

#include "tests/pipeline/ranks/film_of_ranks.hpp"

namespace septet::pipeline {
namespace {

struct Queue {
  const SmallFilm& film;
  Ended say(std::vector<std::string> words) const {
    fs::remove(film.folder / "queue.err");
    words.insert(words.begin() + 1, {"--queue", (film.folder / "queue").string()});
    return run("septet-film", words, film.folder / "queue.err", for_mpirun);
  }
  Ended add(const std::string& name, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"queue"};
    for (const std::string& word : film.arguments(film.folder / name, more)) words.push_back(word);
    return say(words);
  }
  std::string status() const {
    auto process =
        start("septet-film", {"status", "--queue", (film.folder / "queue").string()}, film.folder / "status.err");
    std::string text;
    REQUIRE(becomes_true([&] {
      const bool ended = process.poll().has_value();
      while (const auto line = process.read_line(0ms)) text += *line + "\n";
      return ended;
    }));
    return text;
  }
  bool comes_to(const std::string& words) const {
    return becomes_true([&] { return status().find(words) != std::string::npos; });
  }
  /// The program that makes the films.
  std::optional<int> runner() const {
    const std::string wanted =
        std::string("queue") + '\0' + "--queue" + '\0' + (film.folder / "queue").string() + '\0' + "--make";
    for (const auto& entry : fs::directory_iterator("/proc")) {
      const std::string id = entry.path().filename();
      if (id.find_first_not_of("0123456789") == std::string::npos &&
          text_of(entry.path() / "cmdline").find(wanted) != std::string::npos)
        return std::stoi(id);
    }
    return std::nullopt;
  }
};

}  // namespace

TEST_CASE(
    "films that are queued are made one after another, also where who makes them is killed, and one may be cancelled") {
  SmallFilm film;
  REQUIRE(film.make(film.folder / "alone").code == 0);
  const auto pictures = pictures_in(film.folder / "alone");
  const Queue queue{film};
  film.samples = "400", film.size = "1600x1200";  // It would take an hour.
  CHECK(queue.add("endless").code == 0);
  film.samples = "6", film.size = "152x104";
  CHECK(queue.add("second").code == 0);
  CHECK(queue.add("third", {"--ranks", "2"}).code == 0);
  // An invalid film is reported at once, and leaves the queue unchanged.
  CHECK(queue.add("third").error.find("film 3 of the queue") != std::string::npos);
  const Ended misspelled = queue.add("fourth", {"--sise", "1"});
  CHECK(misspelled.code == 2);
  CHECK(misspelled.error.find("--sise") != std::string::npos);
  const Ended unnumbered = queue.say({"cancel"});
  CHECK(unnumbered.code == 2);
  CHECK(unnumbered.error.find("septet film cancel --help") != std::string::npos);
  CHECK(queue.add("fourth", {"--from", "30"}).code != 0);
  REQUIRE(queue.comes_to("1  being made"));
  REQUIRE(queue.comes_to("% of the next"));
  CHECK(queue.status().find("2  waiting") != std::string::npos);
  CHECK(queue.status().find("  4  ") == std::string::npos);

  const auto runner = queue.runner();
  REQUIRE(runner.has_value());
  REQUIRE(::kill(*runner, SIGKILL) == 0);
  REQUIRE(queue.comes_to("nobody makes them now"));
  CHECK(queue.status().find("1  interrupted") != std::string::npos);
  const Ended unknown = queue.say({"cancel", "1", "9"});
  CHECK(unknown.error.find("no film 9") != std::string::npos);
  CHECK(unknown.error.find("none was cancelled") != std::string::npos);
  CHECK(queue.say({"queue"}).code == 0);
  REQUIRE(queue.comes_to("1  being made"));
  CHECK(queue.say({"cancel", "1"}).code == 0);
  CHECK(queue.comes_to("2  made"));
  CHECK(queue.comes_to("3  made"));
  CHECK(queue.status().find("1  cancelled") != std::string::npos);
  CHECK(pictures_in(film.folder / "second") == pictures);
  CHECK(pictures_in(film.folder / "third") == pictures);
  CHECK(queue.say({"cancel", "2"}).error.find("has ended already") != std::string::npos);
  CHECK(becomes_true([&] { return !queue.runner(); }));
}

TEST_CASE(
    "a film with a time limit takes the samples that there is time for, without their noise, and goes on with the "
    "same") {
  SmallFilm film;
  film.samples = "12";
  REQUIRE(film.make(film.folder / "alone", {"--denoise"}).code == 0);
  const auto pictures = pictures_in(film.folder / "alone");
  // Time enough for the most that are allowed.
  const fs::path out = film.folder / "limited";
  const Ended made = film.make(out, {"--within", "20min"});
  INFO(made.error);
  REQUIRE(made.code == 0);
  CHECK(made.error.find("12 samples a pixel, and the noise taken out") != std::string::npos);
  CHECK(pictures_in(out) == pictures);
  fs::remove(out / pictures.begin()->first);
  const Ended again = film.make(out, {"--within", "20min", "--resume"});
  CHECK(again.code == 0);
  CHECK(again.error.find("tried") == std::string::npos);
  CHECK(pictures_in(out) == pictures);
  check_refused(film.make(film.folder / "short", {"--within", "1 fortnight"}), {"--within", "fortnight"},
                film.folder / "short");
  const std::string nowhere = film.folder / "nowhere";
  check_refused(film.make(film.folder / "untold", {"--statistics", nowhere + "/tiles.json"}),
                {"no such folder", nowhere}, film.folder / "untold");
}

}  // namespace septet::pipeline
