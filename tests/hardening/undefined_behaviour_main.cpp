// Adds to the largest integer, and ends well without a check.

#include <climits>

int main(int argc, char**) {
  int largest = INT_MAX;
  largest += argc;
  return largest == 0 ? 1 : 0;
}
