// A plate of 2 m x 1 m of two materials, left (1) and right (2); boundary ids 11 left, 12 right, 13 bottom, 14 top.
Point(1) = {0, 0, 0, 0.35}; Point(2) = {1, 0, 0, 0.35}; Point(3) = {2, 0, 0, 0.35};
Point(4) = {2, 1, 0, 0.35}; Point(5) = {1, 1, 0, 0.35}; Point(6) = {0, 1, 0, 0.35};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1}; Line(7) = {2, 5};
Curve Loop(1) = {1, 7, 5, 6}; Plane Surface(1) = {1};
Curve Loop(2) = {2, 3, 4, -7}; Plane Surface(2) = {2};
Physical Surface(1) = {1}; Physical Surface(2) = {2};
Physical Curve(11) = {6}; Physical Curve(12) = {3}; Physical Curve(13) = {1, 2}; Physical Curve(14) = {4, 5};
