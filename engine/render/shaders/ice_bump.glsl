// Normal of a surface uneven by waves that are fixed to the ice at rest, after Mikkelsen, "Bump Mapping Unparametrized
// Surfaces on the GPU" (2010); the waves' slopes are exact, so that neighbouring pixels agree.
vec3 bumped(vec3 n, vec3 place, vec3 rest, float share) {
  vec3 across = dFdx(place), down = dFdy(place), rest_across = dFdx(rest), rest_down = dFdy(rest);
  if (ice.u.w == 0.0) return n;
  vec3 q = rest * ice.v.w;
  q += 0.8 * sin(q.yzx * 0.53 + vec3(0.3, 1.7, 2.9));
  const vec3 ways[5] = vec3[](vec3(0.81, 0.42, 0.41), vec3(-0.38, 0.85, 0.36), vec3(0.31, -0.45, 0.84),
                              vec3(1.31, -1.07, 0.77), vec3(-0.93, 1.21, 1.43));
  vec3 slope = vec3(0.0);
  for (int i = 0; i < 5; ++i) slope += ways[i] * cos(dot(ways[i], q) + float(i) * 1.9);
  slope *= ice.u.w * 0.5 * share;
  vec3 a = cross(down, n), b = cross(n, across);
  float area = dot(across, a);
  vec3 gradient = sign(area) * (dot(slope, rest_across) * a + dot(slope, rest_down) * b);
  vec3 sum = abs(area) * n - gradient;
  return dot(sum, sum) > 0.0 ? normalize(sum) : n;
}
