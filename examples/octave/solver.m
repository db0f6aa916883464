% The paper's torques in Octave, as a process: ursula validate SCENARIO --solver 'octave-cli --quiet solver.m [ERROR]'
%
% Virtual work with the velocity of each leg's end, for legs of the paper's kind (U-R-S) that are all alike, without
% friction and load: a scenario such as scenarios/paper-helix.toml. ERROR is put into the torques, relative.
1;

function values = numbers(text, key)
  % One row for each `key = 1.0` or `key = [1.0, …]`.
  found = regexp(text, ['\<' key '\s*=\s*\[?([-+.\deE, ]+)'], 'tokens');
  values = cell2mat(cellfun(@(each) sscanf(strrep(each{1}, ',', ' '), '%f').', found(:), 'UniformOutput', false));
end

function part = section(text, from, to)
  part = regexp(text, [from '(.*?)' to], 'tokens', 'once'){1};
end

function machine = read_machine(file)
  text = regexprep(fileread(file), '#[^\n]*', '');
  platform = section(text, '\[manipulator\.platform\]', '\n\[');
  links = {section(text, 'proximal\s*=\s*\{', '\}'), section(text, 'distal\s*=\s*\{', '\}')};
  machine.g = numbers(text, 'gravity').';
  machine.m = numbers(platform, 'mass');
  machine.rho = numbers(platform, 'center_of_mass').';
  machine.I = diag(numbers(platform, 'inertia'));
  for k = 1:2
    machine.link(k) = struct('l', numbers(links{k}, 'length'), 'm', numbers(links{k}, 'mass'), ...
                             'c', numbers(links{k}, 'center_of_mass'), 'I', numbers(links{k}, 'inertia'));
  end
  machine.a = numbers(text, 'base_point').';
  machine.u = numbers(text, 'base_axis').';
  machine.u = machine.u ./ sqrt(sum(machine.u .^ 2));
  machine.b = numbers(text, 'platform_point').';
end

function c = cross3(a, b)
  c = a([2 3 1], :) .* b([3 1 2], :) - a([3 1 2], :) .* b([2 3 1], :);
end

function X = skew(v)
  X = [0 -v(3) v(2); v(3) 0 -v(1); -v(2) v(1) 0];
end

function Q = rotation(q)
  X = skew(q(2:4));
  Q = eye(3) + 2 * q(1) * X + 2 * X * X;
end

% I ω̇ + ω × I ω of six links with axes x, y, z.
function n = inertia_torque(I, x, y, z, w, w_dot)
  times = @(v) x .* (I(1) * sum(x .* v)) + y .* (I(2) * sum(y .* v)) + z .* (I(3) * sum(z .* v));
  n = times(w_dot) + cross3(w, times(w));
end

% Columns are legs. v_B = −φ̇ u × r + ψ̇ l x × e + χ̇ s x × d: φ turns about −u, the two links by ψ and χ about x.
function tau = torques(machine, in)
  p = in(2:4);  Q = rotation(in(5:8));  v = in(9:11);  w = in(12:14);  a = in(15:17);  alpha = in(18:20);
  turn = skew(alpha) + skew(w)^2;
  u = machine.u;  [l, s] = machine.link.l;  g = machine.g;
  arm = Q * machine.b;
  r = p + arm - machine.a;
  v_B = v + skew(w) * arm;
  a_B = a + turn * arm;

  % The leg's plane holds u and B; in it a triangle of l, s and |r|.
  along = sum(r .* u);
  z = r - u .* along;  across = sqrt(sum(z .^ 2));  z = z ./ across;
  x = cross3(u, z);
  cosine = (l^2 + s^2 - along .^ 2 - across .^ 2) / (2 * l * s);  sine = sqrt(1 - cosine .^ 2);
  psi = atan2(across, along) + atan2(s * sine, l - s * cosine);
  e = cos(psi) .* u + sin(psi) .* z;  e_turned = cos(psi) .* z - sin(psi) .* u;
  d = -cosine .* e - sine .* e_turned;  d_turned = -cosine .* e_turned + sine .* e;
  ed = l * sum(e_turned .* d);  de = s * sum(d_turned .* e);
  rates = @(v) deal(-sum(v .* x) ./ across, sum(v .* d) ./ ed, sum(v .* e) ./ de);

  [phi, psi, chi] = rates(v_B);
  W = -phi .* u;  x_rate = cross3(W, x);
  w1 = W + psi .* x;  w2 = W + chi .* x;
  e_rate = cross3(w1, e);  d_rate = cross3(w2, d);
  bias = cross3(W, v_B) + l * psi .* (cross3(x_rate, e) + cross3(x, e_rate)) + ...
         s * chi .* (cross3(x_rate, d) + cross3(x, d_rate));
  [phi_dot, psi_dot, chi_dot] = rates(a_B - bias);
  w1_dot = -phi_dot .* u + psi_dot .* x + psi .* x_rate;
  w2_dot = -phi_dot .* u + chi_dot .* x + chi .* x_rate;
  e_ddot = cross3(w1_dot, e) + cross3(w1, e_rate);
  d_ddot = cross3(w2_dot, d) + cross3(w2, d_rate);

  % What the links resist with, its work for φ, ψ, χ, and the force at B that does the same.
  k1 = machine.link(1);  k2 = machine.link(2);
  f1 = k1.m * (k1.c * e_ddot - g);
  f2 = k2.m * (l * e_ddot + k2.c * d_ddot - g);
  n1 = inertia_torque(k1.I, x, cross3(e, x), e, w1, w1_dot);
  n2 = inertia_torque(k2.I, x, cross3(d, x), d, w2, w2_dot);
  for_phi = -sum(u .* (cross3(k1.c * e, f1) + n1 + cross3(l * e + k2.c * d, f2) + n2));
  for_psi = sum(e_turned .* (k1.c * f1 + l * f2)) + sum(x .* n1);
  for_chi = k2.c * sum(d_turned .* f2) + sum(x .* n2);
  F = (-for_phi ./ across) .* x + (for_psi ./ ed) .* d + (for_chi ./ de) .* e;

  % All of it at P, with the platform's own; the motors do its work: Jφᵀ τ = w.
  rho = Q * machine.rho;
  f = machine.m * (a + turn * rho - g);
  I = Q * machine.I * Q.';
  row = -x ./ across;
  tau = [cross3(arm, row); row] \ ([I * alpha + skew(w) * I * w + skew(rho) * f; f] + sum([cross3(arm, F); F], 2));
end

wrong = 0;
if numel(argv()) > 0, wrong = str2double(argv(){end}); end
machine = read_machine(getenv('URSULA_SCENARIO'));
% Not fgetl: that waits for the line after before it gives one.
while numel(motion = fscanf(stdin, '%f,', 20)) == 20
  tau = (1 + wrong) * torques(machine, motion);
  printf('%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n', tau);
  fflush(stdout);
end
