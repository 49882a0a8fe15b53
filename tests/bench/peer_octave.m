% The recipe of Dyk et al. 2023 as an Octave user would write it: ode15s, relative tolerance 1e-6, absolute
% 1e-8 for every state, film by finite volumes and a sparse direct solution, in every right-hand side.
%
% usage: octave-cli peer_octave.m CASE.m RESULT.txt
% CASE.m sets the case, the first state and the times; RESULT.txt gets a line a time: t, state, friction
% moments; its first line has the seconds of the march and the number of right-hand sides.
1;

% film force on the journal in the pad frame
function f = film (e, v, k, s)
  n = s.columns; m = s.rows;
  d_phi = s.arc(k) / n; d_z = s.length / (2 * m);
  face = (0:n)' * d_phi - s.trailing(k);
  middle = face(1:n) + d_phi / 2;
  h_face = s.machined - e(1) * sin (face) - e(2) * cos (face);
  h = s.machined - e(1) * sin (middle) - e(2) * cos (middle);
  along = h_face.^3 / d_phi^2;
  along([1, n + 1]) *= 2;
  beside = h.^3 * (s.radius / d_z)^2;
  source = -6 * s.viscosity * s.speed * s.inner * s.radius * diff (h_face) / d_phi ...
           - 12 * s.viscosity * s.radius^2 * (v(1) * sin (middle) + v(2) * cos (middle));
  % cell (row j, column i) has number (i - 1) m + j
  between = kron (beside, [ones(m - 1, 1); 0]);
  edge = kron (beside, [zeros(m - 1, 1); 2 / (1 - 1 / (3 * m))]);
  up = kron (along(2:n + 1), ones (m, 1));
  down = kron (along(1:n), ones (m, 1));
  across = [0; between(1:end - 1)];
  diagonal = -(up + down + between + across + edge);
  inner_up = up; inner_up(end - m + 1:end) = 0;
  inner_down = down; inner_down(1:m) = 0;
  A = spdiags ([[inner_down(m + 1:end); zeros(m, 1)], between, diagonal, across, [zeros(m, 1); inner_up(1:end - m)]], ...
               [-m, -1, 0, 1, m], n * m, n * m);
  p = max (A \ kron (source, ones (m, 1)), 0);
  total = 2 * s.radius * d_phi * d_z * sum (reshape (p, m, n), 1)';
  f = -[total' * sin(middle); total' * cos(middle)];
end

% right-hand side (1)-(4) and (24), and the friction moments
function [dydt, moments] = rates (t, y, s)
  global evaluations
  evaluations++;
  dydt = zeros (size (y));
  force = s.unbalance * s.speed^2 * [cos(s.speed * t); sin(s.speed * t)] - [s.mass * s.gravity; 0];
  moments = zeros (1, numel (s.theta));
  for k = 1:numel (s.theta)
    q = y(4 + 5 * (k - 1) + (1:5));
    direction = [sin(s.theta(k)); cos(s.theta(k))];
    c = cos (s.theta(k) - q(1)); n = sin (s.theta(k) - q(1));
    r = y(1:2) - (s.pivot(k) + q(3)) * direction;
    w = y(3:4) - q(4) * direction;
    turn = [c, -n; n, c];
    r = turn * r;
    f = film (r + [0; s.centre(k)], turn * w + q(2) * [r(2); -r(1)], k, s);
    force += turn' * f;
    normal = 0;
    if (q(3) > 0)
      normal = ppval (s.contact, q(3));
    end
    velocity = s.ball * q(2);
    steady = s.dynamic + (s.sticking - s.dynamic) * exp (-abs (velocity) / s.stribeck);
    bristle_rate = velocity - s.stiffness * abs (velocity) / steady * q(5);
    moments(k) = s.ball * normal * (s.stiffness * q(5) + s.damping * bristle_rate);
    moment = -f(1) * s.centre(k) - moments(k) + s.pad_mass(k) * s.gravity * s.centre_radial(k) * c;
    radial = -f(2) - normal - s.pad_mass(k) * s.gravity * n + s.pad_mass(k) * s.centre_radial(k) * q(2)^2;
    dydt(4 + 5 * (k - 1) + (1:5)) = [q(2); moment / s.inertia(k); q(4); radial / s.pad_mass(k); bristle_rate];
  end
  dydt(1:4) = [y(3:4); force / s.mass];
end

% Fang's law (11)-(18) from a table over the contact radius
function law = contact (s)
  a = s.outer * logspace (-4, 0, 20001)';
  n = 0.5 - 0.24 * exp (-15.08 * (1 - a / s.outer));
  b = sqrt (pi) / 2 * gamma (n + 1) ./ gamma (n + 1.5);
  g = 2 / pi + (a / s.outer).^2;
  k = s.compliance;
  room = 4 * b .* s.ball * s.outer * k .* (n + 0.5) .* (n + 1) - a.^3 .* 3.8304 .* b * k / s.outer;
  force = a.^3 * pi .* g * s.difference ./ room;
  depth = s.factor * k * b .* (n + 1) .* force ./ (pi * a);
  last = find (room <= 0 | depth > 4e-5, 1) - 1;
  if (isempty (last))
    last = numel (a);
  end
  law = pchip ([0; depth(1:last)], [0; force(1:last)]);
end

global evaluations
words = argv ();
source (words{1});
s.contact = contact (s);
evaluations = 0;
options = odeset ("RelTol", s.relative, "AbsTol", s.absolute);
tic;
[t, y] = ode15s (@(t, y) rates (t, y, s), times, first, options);
seconds = toc;
used = evaluations;
file = fopen (words{2}, "w");
fprintf (file, "%.6g %d\n", seconds, used);
for i = 1:numel (t)
  [~, moments] = rates (t(i), y(i, :)', s);
  fprintf (file, "%.16e ", t(i), y(i, :), moments);
  fprintf (file, "\n");
end
fclose (file);
