#pragma once
/// Another program with a session open, by SQLite alone, while it is written.

#include <sqlite3.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>
#include <utility>

namespace septet::pipeline {

enum class Reading {
  idle,             ///< Reads once and stays connected.
  transaction,      ///< Reads within a transaction that it never ends.
  coming_and_going  ///< Opens, reads and closes 20 times a second.
};

/// Waits for the session, then reads it in its manner until the object goes.
class ForeignReader {
 public:
  ForeignReader(std::filesystem::path session, Reading reading, bool may_write = false)
      : session_(std::move(session)),
        reading_(reading),
        flags_(may_write ? SQLITE_OPEN_READWRITE : SQLITE_OPEN_READONLY) {
    thread_ = std::thread([this] { run(); });
  }
  ForeignReader(const ForeignReader&) = delete;
  ForeignReader& operator=(const ForeignReader&) = delete;
  ~ForeignReader() {
    is_over_ = true;
    thread_.join();
  }
  /// Number of reads of the session.
  int looks() const { return looks_; }

 private:
  void run() {
    const char* sql =
        reading_ == Reading::transaction ? "BEGIN; SELECT count(*) FROM samples" : "SELECT count(*) FROM samples";
    while (!is_over_) {
      sqlite3* database = nullptr;
      if (sqlite3_open_v2(session_.c_str(), &database, flags_, nullptr) == SQLITE_OK &&
          sqlite3_exec(database, sql, nullptr, nullptr, nullptr) == SQLITE_OK) {
        ++looks_;
        while (reading_ != Reading::coming_and_going && !is_over_)
          std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
      sqlite3_close(database);
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }

  std::filesystem::path session_;
  Reading reading_;
  int flags_;
  std::atomic<bool> is_over_ = false;
  std::atomic<int> looks_ = 0;
  std::thread thread_;
};

}  // namespace septet::pipeline
